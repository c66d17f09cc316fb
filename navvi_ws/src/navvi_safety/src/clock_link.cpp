// The time of a robot on another machine, for the nodes of this one: robot_clock, published again
// as clock. It crosses the network once, by UDP: a lost message holds up none that follow, and no
// message waits for an acknowledgement, as roscpp's own subscription to clock does.

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <navvi_types/subscribe.hpp>

int main(int argc, char** argv) {
  ros::init(argc, argv, "clock_link");
  ros::NodeHandle node;
  const ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("clock", 1);
  navvi_types::Overtaken overtaken;
  const boost::function<void(const rosgraph_msgs::Clock::ConstPtr&)> receive =
      [&](const auto& msg) {
        if (!overtaken(msg->clock)) clock.publish(msg);
      };
  const ros::Subscriber robot = node.subscribe<rosgraph_msgs::Clock>(
      "robot_clock", 10, receive, {}, navvi_types::steady_transport());
  ros::spin();
  return 0;
}
