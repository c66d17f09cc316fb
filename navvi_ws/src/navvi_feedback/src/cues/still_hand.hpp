#pragma once

#include <optional>

#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// A hand that rests on a leg that leads straight ahead, though nothing is being said.
struct StillHand {
  bool driven = false;          ///< ahead on this leg
  std::optional<double> urged;  ///< s, on this leg, to push the stick
  std::optional<double> since;  ///< s, neither the hand has moved nor the voice spoken

  void observe(const Observation& now, double time);
  /// The person was told to go straight, and has not begun.
  /// \param again  s, from one word to push the stick to the next
  [[nodiscard]] bool due(double time, double again) const;
};

}  // namespace navvi_feedback::cues
