#include "navvi_safety/command_input.hpp"

#include <ros/console.h>

#include <algorithm>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>

namespace navvi_safety {

ros::TransportHints command_transport(const std::string& host) {
  const bool alone = host == "localhost" || host.rfind("127.", 0) == 0;
  ros::TransportHints hints;
  if (!alone) hints.unreliable();
  return hints.reliable().tcpNoDelay();
}

unsigned CommandInput::link_of(const Header& header) {
  links_.erase(std::remove_if(links_.begin(), links_.end(),
                              [](const auto& link) { return link.first.expired(); }),
               links_.end());
  for (const auto& [known, number] : links_)
    if (known.lock() == header) return number;
  links_.emplace_back(header, ++last_link_);
  return last_link_;
}

void CommandInput::receive(const ros::MessageEvent<const geometry_msgs::TwistStamped>& event,
                           const Instant& now) {
  const std::string& node = event.getPublisherName();
  if (!gate_.admit(node, link_of(event.getConnectionHeaderPtr()))) {
    ROS_WARN_THROTTLE(5.0,
                      "navvi/command: commands of %s are ignored; the parameter driver names the "
                      "node that may drive",
                      node.c_str());
    return;
  }
  if (gate_.reason() == CommandGate::Reason::driver_changed)
    ROS_WARN_THROTTLE(5.0,
                      "navvi/command: commands of %s come by another connection than before; the wheels "
                      "stand until one connection alone has sent zero for a while",
                      node.c_str());
  const unsigned before = gate_.rejected();
  const geometry_msgs::TwistStamped& msg = *event.getConstMessage();
  gate_.receive({navvi_types::from_msg(msg.twist), (now.sim - msg.header.stamp.toSec()) / rate_,
                 msg.header.seq},
                now);
  if (gate_.rejected() != before)
    ROS_WARN_THROTTLE(1.0, "navvi/command: %u commands rejected, not finite, absurdly large or stamped ahead",
                      gate_.rejected());
}

ros::Subscriber see_by(ros::NodeHandle& node, const std::string& topic, CommandGate& gate,
                       const std::function<Instant()>& now) {
  return navvi_types::subscribe<navvi_msgs::Proximity>(
      node, topic, 1, navvi_types::from_msg,
      [&gate, now](const auto& proximity) { gate.see(proximity.things, now()); });
}

ros::Subscriber limit_by(ros::NodeHandle& node, CommandGate& gate,
                         const std::function<Instant()>& now) {
  std::string zones;
  if (node.getParam("nav_node/mesh/zones", zones) && !zones.empty()) gate.limit({}, {});
  return navvi_types::subscribe<navvi_msgs::Zone>(
      node, "navvi/zone", 1, navvi_types::from_msg,
      [&gate, now](const auto& zone) { gate.limit(zone, now()); });
}

LinkOutlet::LinkOutlet(ros::NodeHandle& node)
    : link_(node.advertise<navvi_msgs::LinkState>("navvi/link", 1)) {}

void LinkOutlet::publish(const CommandGate& gate, double wall, std::int64_t stamp) {
  constexpr double kPeriod = 0.5;  // s
  if (wall - last_ < kPeriod && gate.late() == late_) return;
  last_ = wall;
  late_ = gate.late();
  link_.publish(navvi_types::to_msg(gate.link_state(stamp)));
}

}  // namespace navvi_safety
