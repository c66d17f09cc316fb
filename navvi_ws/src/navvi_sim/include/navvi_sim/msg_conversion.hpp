#pragma once

#include <octomap/OcTree.h>
#include <octomap_msgs/Octomap.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "navvi_sim/world_description.hpp"

namespace navvi_sim {

/// Where a moving thing is now.
struct MovingPose {
  std::size_t thing;       ///< index in WorldDescription::things
  Eigen::Isometry3d pose;  ///< in map
};

/// What is drawn of the robot.
struct RobotBody {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< base_link in map, at floor height
  double radius = 0.35;                                    ///< m
  double height = 0.6;                                     ///< m
};

/// `map` as a binary octomap_msgs/Octomap, in the frame map.
[[nodiscard]] octomap_msgs::Octomap to_msg(const octomap::OcTree& map, const ros::Time& stamp);

/// The occupied voxels as cubes, one CUBE_LIST a depth of the tree, as octomap_server draws them.
[[nodiscard]] visualization_msgs::MarkerArray occupied_cells_msg(const octomap::OcTree& map,
                                                                 const ros::Time& stamp);

/// What stands still, one namespace a class; to be latched. A picture cut open, so that a view from
/// behind the robot or from above sees in: walls are drawn to 1.0 m above the floor, everything
/// else to 2.7 m.
[[nodiscard]] visualization_msgs::MarkerArray scene_msg(const WorldDescription& world,
                                                        const ros::Time& stamp);

/// What moves, one namespace a class, and the robot in the namespace `robot`. The markers' ids
/// stay the same from call to call.
[[nodiscard]] visualization_msgs::MarkerArray moving_scene_msg(
    const WorldDescription& world, const std::vector<MovingPose>& movers, const RobotBody& robot,
    const ros::Time& stamp);

}  // namespace navvi_sim
