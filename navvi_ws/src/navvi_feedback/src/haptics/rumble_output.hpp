#pragma once

#include <optional>

#include "haptics/haptics.hpp"

namespace navvi_feedback::haptics {

/// Decides which motor commands are worth a message: each that differs by 1/255 or more, and the
/// present values again every 100 ms, since a feedback message lasts until the next one. The record
/// takes slow changes every 50 ms, and a jump or a stop at once.
class RumbleOutput {
 public:
  struct Due {
    bool changed = false;   ///< worth a row of the record
    bool feedback = false;  ///< send the values to other drivers
    bool moved = false;     ///< and they are other ones
  };

  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] Due update(const Rumble& rumble, double time);

 private:
  Rumble sent_, recorded_;
  std::optional<double> sent_at_;
  std::optional<double> recorded_at_;
};

}  // namespace navvi_feedback::haptics
