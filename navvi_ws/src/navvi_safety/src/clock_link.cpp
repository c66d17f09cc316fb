// The time of a robot on another machine, for the nodes of this one: robot_clock, published again
// as clock. It crosses the network once, by UDP: a lost message holds up none that follow.

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <navvi_config/ros_parameters.hpp>
#include <navvi_safety/command_input.hpp>

int main(int argc, char** argv) {
  navvi_config::init(argc, argv, "clock_link");
  return navvi_config::run_node<navvi_config::NoParameters>([](auto) {
    ros::NodeHandle node;
    const ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("clock", 1);
    ros::Time last;
    // A message that was overtaken would set the time back; a simulator that begins anew does.
    constexpr double kOvertaken = 3.0;  // s
    const boost::function<void(const rosgraph_msgs::Clock::ConstPtr&)> receive =
        [&](const auto& msg) {
          const double back = (last - msg->clock).toSec();
          if (back > 0.0 && back < kOvertaken) return;
          last = msg->clock;
          clock.publish(msg);
        };
    const ros::Subscriber robot = node.subscribe<rosgraph_msgs::Clock>(
        "robot_clock", 10, receive, {}, navvi_safety::command_transport());
    navvi_config::spin();
    return 0;
  });
}
