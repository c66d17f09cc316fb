#pragma once

#include <cmath>

#include "cues/side.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// m/s and rad/s; a slower robot stands.
constexpr double kMoving = 0.05;

[[nodiscard]] inline bool stands(const Observation& now) {
  return now.measured && std::abs(now.measured->linear) <= kMoving;
}

/// It drives at what is on that side.
[[nodiscard]] inline bool approaches(const Observation& now, Side side) {
  if (!now.measured) return false;
  if (side == Side::ahead) return now.measured->linear > kMoving;
  return side == Side::behind && now.measured->linear < -kMoving;
}

}  // namespace navvi_feedback::cues
