#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "navvi_sim/description/footprint.hpp"

namespace navvi_sim {

/// A moving thing at one instant. Frame: map.
struct MoverState {
  std::size_t thing;         ///< index in WorldDescription::things
  Eigen::Isometry3d pose;    ///< of the thing's origin
  double yaw;                ///< rad, its heading
  Eigen::Vector2d velocity;  ///< m/s
  double turn_rate;          ///< rad/s, counter-clockwise
  Extent extent;             ///< around all its shapes (R-NAV-4)
  double height;             ///< m, its top above the floor
};

}  // namespace navvi_sim
