#include "navvi_safety/msg_conversion.hpp"

#include <ros/time.h>

#include <cmath>

namespace navvi_safety {

std::optional<Velocity> from_msg(const geometry_msgs::Twist& twist) {
  for (const double value : {twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x,
                             twist.angular.y, twist.angular.z}) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return Velocity{twist.linear.x, twist.angular.z};
}

geometry_msgs::Twist to_msg(const Velocity& velocity) {
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.linear;
  twist.angular.z = velocity.angular;
  return twist;
}

navvi_msgs::DriveState state_msg(const CommandGate& gate, const ros::Time& stamp) {
  navvi_msgs::DriveState msg;
  msg.header.stamp = stamp;
  msg.state = static_cast<std::uint8_t>(gate.state());
  msg.reason = static_cast<std::uint8_t>(gate.reason());
  msg.rejected = gate.rejected();
  return msg;
}

Instant now() { return {ros::SteadyTime::now().toSec(), ros::Time::now().toSec()}; }

}  // namespace navvi_safety
