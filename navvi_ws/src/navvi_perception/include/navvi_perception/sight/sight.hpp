#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <navvi_types/motion.hpp>
#include <vector>

namespace navvi_perception::sight {

/// What one sensor saw at one instant. Frame: map.
struct Sight {
  std::int64_t stamp = 0;    ///< ns, ROS time
  std::size_t sensor = 0;    ///< which it was; where two see the same thing, the lower one tells it
  bool in_plane = true;      ///< seen in the plane in which a scanner made the prior map
  navvi_types::Pose2 robot;  ///< base_link
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m, of its rays
  std::vector<Eigen::Vector3d> hits;                 ///< m, where rays ended
  std::vector<Eigen::Vector3d> clear = {};           ///< m, as far as rays went that met nothing
};

/// What is known beforehand, as nav_msgs/OccupancyGrid has it: what stands for good.
struct Prior {
  double resolution = 0.05;                          ///< m, edge of a cell
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, lower corner of cell (0, 0) in map
  int width = 0;                                     ///< cells along x
  int height = 0;                                    ///< cells along y
  std::vector<std::int8_t> cells;  ///< row by row: -1 unknown, else 0 (free) to 100 (occupied)
  bool flat = true;  ///< seen in one plane: what is clear there may hold low or high things
  double yaw = 0.0;  ///< rad, by which the grid is turned about that corner

  [[nodiscard]] bool operator==(const Prior& other) const {
    return resolution == other.resolution && origin == other.origin && yaw == other.yaw &&
           width == other.width && height == other.height && cells == other.cells &&
           flat == other.flat;
  }
};

}  // namespace navvi_perception::sight
