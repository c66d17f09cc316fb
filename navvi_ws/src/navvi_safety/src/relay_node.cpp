// The last stage before a real robot's wheels: turns /navvi/command into the robot's velocity, or
// stops.

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Bool.h>

#include <navvi_config/ros_parameters.hpp>
#include <navvi_safety/command_input.hpp>
#include <navvi_types/msg_conversion.hpp>

namespace {

struct NodeConfig {
  navvi_safety::CommandGateConfig gate;
  std::string emergency_stop;  ///< topic of the robot; empty: none

  void describe(navvi_config::Visitor& visit) {
    gate.describe(visit);
    visit(emergency_stop, "emergency_stop", navvi_config::Any{}, "",
          "topic with std_msgs/Bool, true while the robot's emergency stop is pressed: the wheels "
          "stand; empty: none");
  }
};

navvi_safety::Instant instant() {
  return {ros::SteadyTime::now().toSec(), ros::Time::now().toSec()};
}

/// Velocity of the wheels, zero in the end, whatever ends this.
struct Wheels {
  ros::Publisher topic;

  ~Wheels() {
    topic.publish(geometry_msgs::Twist());
    navvi_config::flush();
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (const auto code = navvi_config::print_parameters<NodeConfig>(argc, argv)) return *code;
  navvi_config::init(argc, argv, "relay_node");
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    ros::NodeHandle node;
    navvi_safety::CommandGate gate(config.gate);
    navvi_safety::CommandInput input(gate);
    const Wheels wheels{node.advertise<geometry_msgs::Twist>("cmd_vel", 1)};
    ros::Publisher state = node.advertise<navvi_msgs::DriveState>("navvi/drive_state", 1, true);
    using Command = ros::MessageEvent<const geometry_msgs::TwistStamped>;
    const boost::function<void(const Command&)> receive = [&](const Command& command) {
      input.receive(command, instant());
    };
    ros::Subscriber commands = node.subscribe<geometry_msgs::TwistStamped, const Command&>(
        "navvi/command", navvi_safety::kCommandQueue, receive, {},
        navvi_safety::command_transport());
    ros::Subscriber near;
    if (config.gate.assistance != "off")
      near = navvi_safety::see_by(node, "navvi/proximity", gate, instant);
    const ros::Subscriber zones = navvi_safety::limit_by(node, gate, instant);
    std::optional<navvi_types::DriveState> published;
    const auto publish_state = [&] {
      const auto now = gate.drive_state(navvi_types::to_ns(ros::Time::now()));
      if (published && published->state == now.state && published->reason == now.reason &&
          published->intruder == now.intruder && published->assistance == now.assistance)
        return;
      state.publish(navvi_types::to_msg(now));
      published = now;
    };
    navvi_safety::LinkOutlet link(node);
    // The time of a person's side on another machine, whose own clock says nothing of this one.
    ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("navvi/clock", 1);

    bool pressed = false;
    ros::Subscriber stop;
    const auto step = [&] {
      if (stop && stop.getNumPublishers() == 0)
        ROS_WARN_DELAYED_THROTTLE(10.0, "Nothing publishes the emergency stop, %s.",
                                  config.emergency_stop.c_str());
      if (pressed) gate.stop(navvi_safety::CommandGate::Reason::emergency_stop);
      wheels.topic.publish(navvi_types::to_msg(gate.update(instant())));
      publish_state();
      rosgraph_msgs::Clock now;
      now.clock = ros::Time::now();
      clock.publish(now);
      link.publish(gate, instant().wall, navvi_types::to_ns(ros::Time::now()));
    };
    // By wall clock, so that a stopped simulation clock cannot keep the wheels turning.
    ros::WallTimer timer = node.createWallTimer(ros::WallDuration(0.02), [&](auto&) { step(); });
    if (!config.emergency_stop.empty())
      stop = node.subscribe<std_msgs::Bool>(config.emergency_stop, 10,
                                            [&](const std_msgs::Bool::ConstPtr& msg) {
                                              pressed = msg->data;
                                              step();
                                            });
    navvi_config::spin();
    return 0;
  });
}
