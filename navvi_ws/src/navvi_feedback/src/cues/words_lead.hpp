#pragma once

#include "cues/route_rules.hpp"

namespace navvi_feedback::cues {

/// The strategy where words alone lead: whatever changes where to steer is said, and said again
/// until it is done. While the robot turns nothing is said but "straight ahead", early enough to
/// stop a turn of more than one hour by.
/// \return what is said now; the leg knows of it
[[nodiscard]] Utterances words_lead(const Look& look, Leg& leg);

}  // namespace navvi_feedback::cues
