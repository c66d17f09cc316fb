#pragma once

#include <geometry_msgs/Twist.h>
#include <navvi_msgs/DriveState.h>

#include "navvi_safety/command_gate.hpp"

namespace navvi_safety {

/// nullopt if any of the six numbers is not finite.
[[nodiscard]] std::optional<Velocity> from_msg(const geometry_msgs::Twist& twist);
[[nodiscard]] geometry_msgs::Twist to_msg(const Velocity& velocity);
[[nodiscard]] navvi_msgs::DriveState state_msg(const CommandGate& gate, const ros::Time& stamp);

/// The present instant: monotonic wall clock and ROS time.
[[nodiscard]] Instant now();

}  // namespace navvi_safety
