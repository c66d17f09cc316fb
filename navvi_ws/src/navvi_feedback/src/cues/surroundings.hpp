#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

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

/// What stands for good: a shelf or a wall.
[[nodiscard]] constexpr bool is_structure(ThingClass thing) {
  return thing == ThingClass::shelf || thing == ThingClass::wall;
}
/// As words tell it: a shelf, a wall, or an obstacle.
[[nodiscard]] constexpr About about(ThingClass thing) {
  if (!is_structure(thing)) return About::obstacle;
  return thing == ThingClass::wall ? About::wall : About::shelf;
}

/// \param reach  m, gap \param moves  only what moves about counts
/// \return whether anything nearer than that is in the lane ahead
[[nodiscard]] inline bool anything_ahead(const std::vector<NearThing>& nearby, double reach,
                                         bool moves = false) {
  return std::any_of(nearby.begin(), nearby.end(), [&](const NearThing& thing) {
    return (thing.moving || !moves) && thing.gap < reach &&
           side_of_lane(thing.nearest) == Side::ahead;
  });
}

}  // namespace navvi_feedback::cues
