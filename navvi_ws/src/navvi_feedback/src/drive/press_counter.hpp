#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::drive {

/// Counts how often each button went down, from states that come one after another: a press that
/// begins and ends between two reads of a device is not lost then.
class PressCounter {
 public:
  /// \return the input with its `presses`. A button that is down when the device becomes live, or
  /// in another session, did not go down.
  [[nodiscard]] InputState count(InputState input) {
    presses_.resize(std::max(presses_.size(), input.buttons.size()));
    const bool anew = !last_.live || last_.session != input.session;
    for (std::size_t i = 0; i < input.buttons.size(); ++i)
      if (input.live && !anew && input.buttons[i] && !last_.button(i)) ++presses_[i];
    last_ = input;
    input.presses = presses_;
    return input;
  }

 private:
  InputState last_;
  std::vector<unsigned> presses_;
};

}  // namespace navvi_feedback::drive
