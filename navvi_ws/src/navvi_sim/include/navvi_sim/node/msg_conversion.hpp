#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <navvi_msgs/AppliedCommands.h>
#include <octomap_msgs/Octomap.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstddef>
#include <navvi_types/motion.hpp>
#include <vector>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"

// What only the simulator publishes. The other messages are those of navvi_types.

namespace navvi_sim::node {

/// `map` as a binary octomap_msgs/Octomap, in the frame map.
[[nodiscard]] octomap_msgs::Octomap to_msg(const occupancy::OccupancyMap& map,
                                           const ros::Time& stamp);

/// What is occupied as cubes, one CUBE_LIST a depth of the tree, as octomap_server draws them; a
/// map of more than `most` is drawn as coarse as it must be.
[[nodiscard]] visualization_msgs::MarkerArray occupied_cells_msg(const occupancy::OccupancyMap& map,
                                                                 const ros::Time& stamp,
                                                                 std::size_t most = 1000000);

/// odom -> base_link
[[nodiscard]] geometry_msgs::TransformStamped base_link_msg(const navvi_types::Odometry& odometry);
/// map -> odom: what corrects the odometry, so that map -> base_link is the truth. The identity
/// where the odometry does not drift.
[[nodiscard]] geometry_msgs::TransformStamped odom_msg(const live::Snapshot& now);

/// The commands from number `first` on.
[[nodiscard]] navvi_msgs::AppliedCommands applied_commands_msg(
    const std::vector<live::AppliedCommand>& commands, std::size_t first, const ros::Time& stamp);
/// Adds to `commands`, every command of the world so far, those of a message that are new. False
/// if commands are missing between, or the message is not in order: nothing is added then.
[[nodiscard]] bool append(const navvi_msgs::AppliedCommands& msg,
                          std::vector<live::AppliedCommand>& commands);

}  // namespace navvi_sim::node
