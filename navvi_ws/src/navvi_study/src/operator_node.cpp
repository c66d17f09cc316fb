// A simulated person at the stick: hears navvi/cues, feels joy/set_feedback, and knows nothing
// else.

#include <navvi_msgs/Cue.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/JoyFeedbackArray.h>

#include <algorithm>
#include <cmath>
#include <navvi_config/ros_parameters.hpp>

#include "navvi_study/msg_conversion.hpp"
#include "navvi_study/simulated_operator.hpp"

namespace {

struct NodeConfig {
  int seed = 0;
  double rate = 50.0;
  navvi_study::SimulatedOperatorConfig hand;

  void describe(navvi_config::Visitor& visit) {
    visit({"seed", navvi_config::Range{0, 2147483647}, "", "of reaction times and errors"}, seed);
    visit({"rate", navvi_config::Range{10, 200}, "Hz", "of joy messages"}, rate);
    visit.group("operator", hand);
  }
};

double wall() { return ros::SteadyTime::now().toSec(); }

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "operator_node");
  ros::NodeHandle node;
  try {
    const auto config = navvi_config::load<NodeConfig>(ros::NodeHandle("~"));
    navvi_study::SimulatedOperator person(config.hand, static_cast<std::uint64_t>(config.seed));
    double left = 0.0;
    double right = 0.0;
    ros::Publisher joy = node.advertise<sensor_msgs::Joy>("joy", 1);
    // Ear and hand live by the wall clock, as people do.
    ros::Subscriber cues = node.subscribe<navvi_msgs::Cue>(
        "navvi/cues", 100, [&](const navvi_msgs::Cue::ConstPtr& msg) {
          if (const auto speech = navvi_study::heard(*msg)) person.hear(*speech, wall());
        });
    ros::Subscriber rumble = node.subscribe<sensor_msgs::JoyFeedbackArray>(
        "joy/set_feedback", 10, [&](const sensor_msgs::JoyFeedbackArray::ConstPtr& msg) {
          for (const auto& motor : msg->array) {
            if (motor.type != sensor_msgs::JoyFeedback::TYPE_RUMBLE) continue;
            if (!std::isfinite(motor.intensity)) continue;
            (motor.id == 0 ? left : right) = std::clamp<double>(motor.intensity, 0.0, 1.0);
          }
          person.feel(left, right);
        });
    double last = wall();
    ros::WallTimer timer =
        node.createWallTimer(ros::WallDuration(1.0 / config.rate), [&](const ros::WallTimerEvent&) {
          const double now = wall();
          joy.publish(navvi_study::to_msg(person.update(now, now - last), ros::Time::now()));
          last = now;
        });
    ros::spin();
  } catch (const navvi_config::ConfigError& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}
