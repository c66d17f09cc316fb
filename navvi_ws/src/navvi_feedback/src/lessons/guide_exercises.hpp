#pragma once

#include <memory>

#include "lessons/exercise.hpp"

namespace navvi_feedback::lessons {

/// Let go at "wait", stand until "go on", and then drive `amount` m straight on, as it says.
/// \param tries  at this step so far, with this one
[[nodiscard]] std::unique_ptr<Exercise> begin_wait(const Step& step, int tries);

/// Back by `amount` m, straight, when the guide says so.
[[nodiscard]] std::unique_ptr<Exercise> begin_back_away(const Step& step);

/// Turn by `amount` degrees clockwise, which are whole hours, and drive a metre, when the guide
/// says so.
[[nodiscard]] std::unique_ptr<Exercise> begin_make_room(const Step& step);

}  // namespace navvi_feedback::lessons
