#include "navvi_safety/msg_conversion.hpp"

namespace navvi_safety {

navvi_msgs::DriveState state_msg(const CommandGate& gate, const ros::Time& stamp) {
  DriveState state = gate.drive_state();
  state.stamp = navvi_types::to_ns(stamp);
  return to_msg(state);
}

Instant now() { return {ros::SteadyTime::now().toSec(), ros::Time::now().toSec()}; }

}  // namespace navvi_safety
