#pragma once

#include <ros/ros.h>

#include "navvi_safety/command_gate.hpp"

namespace navvi_safety {

/// Publishes the connection's state on navvi/link: 2 Hz, and when commands begin or cease to come
/// late.
class LinkOutlet {
 public:
  explicit LinkOutlet(ros::NodeHandle& node);
  /// Call it at every control step. \param wall  s, monotonic
  void publish(const CommandGate& gate, double wall, std::int64_t stamp);

 private:
  ros::Publisher link_;
  double last_ = -1e9;  ///< s
  LinkMeter::Late late_ = LinkMeter::Late::no;
};

}  // namespace navvi_safety
