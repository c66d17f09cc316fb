#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/message_event.h>

#include "navvi_safety/command_gate.hpp"

namespace navvi_safety {

/// Messages that a subscriber to commands may hold: with fewer, a node that floods the topic
/// would push those of the driver out.
constexpr int kCommandQueue = 100;

/// Passes a command on to the gate if its publisher may drive; warns of what is rejected.
void receive(CommandGate& gate, const ros::MessageEvent<const geometry_msgs::Twist>& event,
             const Instant& now);

}  // namespace navvi_safety
