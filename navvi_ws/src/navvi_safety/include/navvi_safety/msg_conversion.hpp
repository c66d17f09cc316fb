#pragma once

#include <navvi_types/msg_conversion.hpp>

#include "navvi_safety/command_gate.hpp"

namespace navvi_safety {

using navvi_types::from_msg;
using navvi_types::to_msg;

[[nodiscard]] navvi_msgs::DriveState state_msg(const CommandGate& gate, const ros::Time& stamp);

/// The present instant: monotonic wall clock and ROS time.
[[nodiscard]] Instant now();

}  // namespace navvi_safety
