#pragma once

#include <optional>

#include "navvi_feedback/haptics/haptics.hpp"

namespace navvi_feedback::haptics {

/// Decides which motor commands are worth a message: a change of 1/255 or more at most every 50 ms,
/// a stop at once, and the present values again every 100 ms, since a feedback message lasts until
/// the next one.
class RumbleOutput {
 public:
  struct Due {
    bool changed = false;   ///< other values than the last time
    bool feedback = false;  ///< send the values to other drivers
  };

  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] Due update(const Rumble& rumble, double time);

 private:
  Rumble sent_;
  std::optional<double> sent_at_;
  std::optional<double> changed_at_;
};

}  // namespace navvi_feedback::haptics
