#pragma once

#include <optional>

#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// A hand that rests on a leg that leads straight ahead, though nothing is being said.
struct StillHand {
  bool driven = false;          ///< ahead on this leg
  bool urged = false;           ///< on this leg, to push the stick
  std::optional<double> since;  ///< s, neither the hand has moved nor the voice spoken

  void observe(const Observation& now, double time);
  /// The person was told to go straight, and has not begun.
  [[nodiscard]] bool due(double time) const;
};

}  // namespace navvi_feedback::cues
