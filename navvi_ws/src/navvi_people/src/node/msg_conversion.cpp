#include "node/msg_conversion.hpp"

namespace navvi_people::node {

sensor_msgs::Joy to_msg(const people::StickAndButtons& hand, const ros::Time& stamp) {
  sensor_msgs::Joy msg;
  msg.header.stamp = stamp;
  msg.axes = {static_cast<float>(hand.left), static_cast<float>(hand.forward)};
  msg.buttons = {hand.repeat ? 1 : 0, 0, 0, 0, 0, 0, hand.start ? 1 : 0};
  return msg;
}

}  // namespace navvi_people::node
