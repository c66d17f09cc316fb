#pragma once

#include <octomap/OcTree.h>
#include <octomap_msgs/Octomap.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

namespace navvi_sim {

/// `map` as a binary octomap_msgs/Octomap, in the frame map.
[[nodiscard]] octomap_msgs::Octomap to_msg(const octomap::OcTree& map, const ros::Time& stamp);

/// The occupied voxels as cubes, one CUBE_LIST a depth of the tree, as octomap_server draws them.
[[nodiscard]] visualization_msgs::MarkerArray occupied_cells_msg(const octomap::OcTree& map,
                                                                 const ros::Time& stamp);

}  // namespace navvi_sim
