#include "navvi_safety/link_outlet.hpp"

#include <navvi_types/msg_conversion.hpp>

namespace navvi_safety {
namespace {

constexpr double kPeriod = 0.5;  // s

}  // namespace

LinkOutlet::LinkOutlet(ros::NodeHandle& node)
    : link_(node.advertise<navvi_msgs::LinkState>("navvi/link", 1)) {}

void LinkOutlet::publish(const CommandGate& gate, double wall, std::int64_t stamp) {
  if (wall - last_ < kPeriod && gate.late() == late_) return;
  last_ = wall;
  late_ = gate.late();
  link_.publish(navvi_types::to_msg(gate.link_state(stamp)));
}

}  // namespace navvi_safety
