// A simulated person at the stick: hears navvi/cues, feels joy/set_feedback, and knows nothing
// else.

#include <ros/package.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/JoyFeedbackArray.h>

#include <algorithm>
#include <cmath>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/subscribe.hpp>

#include "navvi_people/people/simulated_operator.hpp"
#include "node/msg_conversion.hpp"

namespace {

struct NodeConfig {
  double rate = 50.0;
  navvi_people::people::SimulatedOperatorConfig person;

  void describe(navvi_config::Visitor& visit) {
    visit(rate, "rate", navvi_config::Range{10, 200}, "Hz", "of joy messages");
    visit.group("person", person);
  }
};

double now() { return ros::Time::now().toSec(); }

}  // namespace

int main(int argc, char** argv) {
  if (const auto code = navvi_config::print_parameters<NodeConfig>(argc, argv)) return *code;
  navvi_config::init(argc, argv, "operator_node");
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    ros::NodeHandle node;
    // The person speaks the language of the session.
    const std::string feedback = ros::names::resolve("feedback_node");
    std::string phrases = ros::param::param<std::string>(feedback + "/phrases", "");
    if (phrases.empty())
      phrases = ros::package::getPath("navvi_feedback") + "/config/phrases/" +
                ros::param::param<std::string>(feedback + "/language", "en") + ".yaml";
    const int world = ros::param::param<int>(ros::names::resolve("sim_node") + "/seed", 0);
    navvi_people::people::SimulatedOperatorConfig taught = config.person.typed();
    ros::param::param<std::string>(feedback + "/lead", taught.lead, taught.lead);
    navvi_people::people::SimulatedOperator person(
        taught, navvi_people::people::Listener(phrases), world);
    double left = 0.0;
    double right = 0.0;
    ros::Publisher joy = node.advertise<sensor_msgs::Joy>("joy", 1);
    const ros::Subscriber cues = navvi_types::subscribe<navvi_msgs::Cue>(
        node, "navvi/cues", 100, navvi_types::from_msg, [&](const navvi_types::CueEvent& cue) {
          if (const auto heard = navvi_people::people::heard(cue)) person.hear(*heard, now());
        });
    ros::Subscriber rumble = node.subscribe<sensor_msgs::JoyFeedbackArray>(
        "joy/set_feedback", 10, [&](const sensor_msgs::JoyFeedbackArray::ConstPtr& msg) {
          for (const auto& motor : msg->array) {
            if (motor.type != sensor_msgs::JoyFeedback::TYPE_RUMBLE) continue;
            if (!std::isfinite(motor.intensity)) continue;
            (motor.id == 0 ? left : right) = std::clamp<double>(motor.intensity, 0.0, 1.0);
          }
          person.feel({left, right}, now());
        });
    // The timer beats by the wall clock, but a turn is as long as the world's time says, also where
    // a busy machine slows the world down.
    double last = 0.0;
    ros::WallTimer timer =
        node.createWallTimer(ros::WallDuration(1.0 / config.rate), [&](const ros::WallTimerEvent&) {
          const double time = std::max(last, now());
          navvi_people::people::StickAndButtons hand;
          if (last > 0.0) hand = person.update(time, time - last);
          last = time;
          joy.publish(navvi_people::node::to_msg(hand, ros::Time::now()));
        });
    navvi_config::spin();
    return 0;
  });
}
