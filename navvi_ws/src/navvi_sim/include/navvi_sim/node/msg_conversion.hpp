#pragma once

#include <octomap_msgs/Octomap.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstddef>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::node {

/// `map` as a binary octomap_msgs/Octomap, in the frame map.
[[nodiscard]] octomap_msgs::Octomap to_msg(const occupancy::OccupancyMap& map,
                                           const ros::Time& stamp);

/// What is occupied as cubes, one CUBE_LIST a depth of the tree, as octomap_server draws them; a
/// map of more than `most` is drawn as coarse as it must be.
[[nodiscard]] visualization_msgs::MarkerArray occupied_cells_msg(const occupancy::OccupancyMap& map,
                                                                 const ros::Time& stamp,
                                                                 std::size_t most = 1000000);

}  // namespace navvi_sim::node
