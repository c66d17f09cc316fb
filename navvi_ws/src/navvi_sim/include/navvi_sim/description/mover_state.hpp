#pragma once

#include <Eigen/Geometry>
#include <navvi_types/thing.hpp>

namespace navvi_sim {

/// A thing with a route at one instant.
struct MoverState {
  navvi_types::MovingThing thing;                          ///< its id: WorldDescription::things
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of its origin, in map
};

}  // namespace navvi_sim
