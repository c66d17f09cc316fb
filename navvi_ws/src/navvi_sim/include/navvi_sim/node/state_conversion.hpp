#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <navvi_msgs/AppliedCommands.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Obstacles.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/Scenario.h>
#include <navvi_msgs/StateHash.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/live/world.hpp"
#include "navvi_sim/scenario/scenario.hpp"

namespace navvi_sim::node {

constexpr double kProximityRate = 50.0;  ///< Hz, simulated
constexpr double kObstaclesRate = 20.0;  ///< Hz, simulated

/// odom -> base_link, the pose at floor height, the twist in base_link.
/// \param odometry  Snapshot::odometry
[[nodiscard]] nav_msgs::Odometry odometry_msg(const physics::RobotState& odometry,
                                              double floor_height, const ros::Time& stamp);
/// odom -> base_link
[[nodiscard]] geometry_msgs::TransformStamped base_link_msg(const physics::RobotState& odometry,
                                                            double floor_height,
                                                            const ros::Time& stamp);
/// map -> odom: what corrects the odometry, so that map -> base_link is the truth. The identity
/// where the odometry does not drift.
[[nodiscard]] geometry_msgs::TransformStamped odom_msg(const physics::RobotState& robot,
                                                       const physics::RobotState& odometry,
                                                       const ros::Time& stamp);

/// Every moving thing as a cylinder on the floor, and as a rectangle where that says more (Extent),
/// in map.
[[nodiscard]] navvi_msgs::Obstacles obstacles_msg(const WorldDescription& world,
                                                  const live::Snapshot& now,
                                                  const ros::Time& stamp);

/// `things` of World::proximity, taken over to base_link.
[[nodiscard]] navvi_msgs::Proximity proximity_msg(const WorldDescription& world,
                                                  const physics::RobotState& robot,
                                                  const std::vector<physics::NearThing>& things,
                                                  double detection_radius, const ros::Time& stamp);

[[nodiscard]] navvi_msgs::Contact contact_msg(const WorldDescription& world,
                                              const physics::RobotState& robot,
                                              const physics::ContactEvent& contact,
                                              const ros::Time& stamp);

[[nodiscard]] navvi_msgs::Scenario scenario_msg(const WorldDescription& world,
                                                const std::string& world_hash, std::uint64_t seed,
                                                const scenario::Scenario& scenario,
                                                const ros::Time& stamp);

/// The commands from number `first` on.
[[nodiscard]] navvi_msgs::AppliedCommands applied_commands_msg(
    const std::vector<live::AppliedCommand>& commands, std::size_t first, const ros::Time& stamp);
[[nodiscard]] navvi_msgs::StateHash state_hash_msg(const live::StateHash& state,
                                                   const ros::Time& stamp);

/// Adds to `commands`, every command of the world so far, those of a message that are new. False
/// if commands are missing between, or the message is not in order: nothing is added then.
[[nodiscard]] bool append(const navvi_msgs::AppliedCommands& msg,
                          std::vector<live::AppliedCommand>& commands);
/// nullopt if its hash is not 16 hexadecimal digits.
[[nodiscard]] std::optional<live::StateHash> from_msg(const navvi_msgs::StateHash& msg);

}  // namespace navvi_sim::node
