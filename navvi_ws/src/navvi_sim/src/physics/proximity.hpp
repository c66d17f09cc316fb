#pragma once

#include <cstddef>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "physics/bodies.hpp"
#include "physics/hull_gap.hpp"

namespace navvi_sim::physics {

/// How near a thing is, in map.
struct ThingGap : Gap {
  std::size_t thing = 0;  ///< index in WorldDescription::things
};

/// The nearest surface point of each thing whose gap to the robot's hull is at most `radius` m,
/// nearest first. The time taken follows what is near.
/// \param movers  everything that moves, where it is now
[[nodiscard]] std::vector<ThingGap> things_near(const Hull& hull, double radius,
                                                const Bodies& bodies,
                                                const std::vector<MoverState>& movers);

}  // namespace navvi_sim::physics
