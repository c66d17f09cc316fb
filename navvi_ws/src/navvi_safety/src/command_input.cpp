#include "navvi_safety/command_input.hpp"

#include <ros/console.h>

#include <navvi_types/msg_conversion.hpp>

namespace navvi_safety {

void receive(CommandGate& gate, const ros::MessageEvent<const geometry_msgs::Twist>& event,
             const Instant& now) {
  const std::string& node = event.getPublisherName();
  if (!gate.admit(node)) {
    ROS_WARN_THROTTLE(5.0,
                      "cmd_vel: commands of %s are ignored; the parameter driver names the "
                      "node that may drive",
                      node.c_str());
    return;
  }
  const unsigned before = gate.rejected();
  gate.receive(navvi_types::from_msg(*event.getConstMessage()), now);
  if (gate.rejected() != before)
    ROS_WARN_THROTTLE(1.0, "cmd_vel: %u commands rejected, not finite or absurdly large",
                      gate.rejected());
}

}  // namespace navvi_safety
