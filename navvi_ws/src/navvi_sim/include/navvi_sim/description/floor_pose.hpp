#pragma once

namespace navvi_sim {

/// A pose on the floor, in map.
struct FloorPose {
  double x = 0.0;    ///< m
  double y = 0.0;    ///< m
  double yaw = 0.0;  ///< rad, counter-clockwise from x
};

}  // namespace navvi_sim
