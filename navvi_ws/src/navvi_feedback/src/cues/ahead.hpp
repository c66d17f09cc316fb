#pragma once

#include <algorithm>
#include <vector>

#include "cues/side.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// \param reach  m, gap
/// \return whether anything nearer than that is in the lane ahead
[[nodiscard]] inline bool anything_ahead(const std::vector<NearThing>& nearby, double reach) {
  return std::any_of(nearby.begin(), nearby.end(), [&](const NearThing& thing) {
    return thing.gap < reach && side_of_lane(thing.nearest) == Side::ahead;
  });
}

/// Likewise, of what moves about.
[[nodiscard]] inline bool mover_ahead(const std::vector<NearThing>& nearby, double reach) {
  return std::any_of(nearby.begin(), nearby.end(), [&](const NearThing& thing) {
    return thing.moving && thing.gap < reach && side_of_lane(thing.nearest) == Side::ahead;
  });
}

}  // namespace navvi_feedback::cues
