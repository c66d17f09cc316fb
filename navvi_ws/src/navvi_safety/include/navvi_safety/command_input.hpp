#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <ros/network.h>
#include <ros/ros.h>

#include <boost/weak_ptr.hpp>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "navvi_safety/command_gate.hpp"

namespace navvi_safety {

/// Messages that a subscriber to commands may hold: with fewer, a node that floods the topic
/// would push those of the driver out.
constexpr int kCommandQueue = 100;

/// How commands come: from another machine by UDP, so that one that is lost holds up none that
/// follow. \param host  at which this node listens
[[nodiscard]] ros::TransportHints command_transport(
    const std::string& host = ros::network::getHost());

/// Passes commands on to the gate if their publisher may drive; warns of what is rejected.
class CommandInput {
 public:
  /// \param gate  outlives this \param rate  s of ROS time in one s
  explicit CommandInput(CommandGate& gate, double rate = 1.0) : gate_(gate), rate_(rate) {}

  void receive(const ros::MessageEvent<const geometry_msgs::TwistStamped>& event,
               const Instant& now);

 private:
  using Header = boost::shared_ptr<ros::M_string>;

  /// The number of the connection that a message came by. A connection keeps one header as long as
  /// it lives, and no two share one; names in it may be forged.
  [[nodiscard]] unsigned link_of(const Header& header);

  CommandGate& gate_;
  double rate_;
  std::vector<std::pair<boost::weak_ptr<ros::M_string>, unsigned>> links_;  ///< that still live
  unsigned last_link_ = 0;
};

/// Shows the gate what is near. \param topic  with navvi_msgs/Proximity
[[nodiscard]] ros::Subscriber see_by(ros::NodeHandle& node, const std::string& topic,
                                     CommandGate& gate, const std::function<Instant()>& now);

/// Shows the gate what zones allow: navvi/zone, which nav_node publishes where there are any. Where
/// nav_node is to have some, the robot is slow until the first message.
[[nodiscard]] ros::Subscriber limit_by(ros::NodeHandle& node, CommandGate& gate,
                                       const std::function<Instant()>& now);

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
