#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "navvi_sim/description/mover_state.hpp"
#include "navvi_sim/physics/bodies.hpp"
#include "navvi_sim/physics/hull_gap.hpp"

namespace navvi_sim::physics {

/// A thing near the robot (R-SIM-7).
struct NearThing {
  std::size_t thing;        ///< index in WorldDescription::things
  double gap;               ///< m, hull to surface; 0 or less when touching
  Eigen::Vector3d nearest;  ///< m, nearest point of its surface, in map
};

/// The nearest surface point of each thing whose gap to the robot's hull is at most `radius` m,
/// nearest first. Shapes and triangles wholly below the hull, or whose underside is above
/// `ceiling`, m, z in map, are left out. The time taken follows what is near.
/// \param movers  everything that moves, where it is now
[[nodiscard]] std::vector<NearThing> things_near(const Hull& hull, double radius, double ceiling,
                                                 const Bodies& bodies,
                                                 const std::vector<MoverState>& movers);

}  // namespace navvi_sim::physics
