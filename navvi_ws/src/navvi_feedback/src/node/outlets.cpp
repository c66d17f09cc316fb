#include "node/outlets.hpp"

#include <geometry_msgs/TwistStamped.h>

#include <algorithm>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/msg_conversion.hpp>

#include "navvi_feedback/node/msg_conversion.hpp"

namespace navvi_feedback::node {
namespace {

using navvi_types::to_msg;

constexpr double kMarkers = 0.1;  // s
constexpr char kPicture[] = "/rviz";

std::int64_t stamp() { return navvi_types::to_ns(ros::Time::now()); }

}  // namespace

Outlets::Outlets(ros::NodeHandle& node, const NodeConfig& config, bool own_hands)
    : motors_driver_(config.motors) {
  commands_ = node.advertise<geometry_msgs::TwistStamped>("navvi/command", 1);
  motors_ = node.advertise<sensor_msgs::JoyFeedbackArray>("joy/set_feedback", 10);
  cues_ = node.advertise<navvi_msgs::Cue>("navvi/cues", 100);
  goals_ = node.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  requests_ = node.advertise<navvi_msgs::TrialRequest>("navvi/trial_request", 10);
  orders_ = node.advertise<navvi_msgs::Cue>("navvi/order", 1, true);
  const auto joined = [this](const ros::SingleSubscriberPublisher& reader) {
    if (reader.getSubscriberName() == kPicture) picture_back_ = std::exchange(pictured_, true);
  };
  markers_ =
      node.advertise<visualization_msgs::MarkerArray>("navvi/markers", 1, joined, {}, {}, true);
  diagnostics_ = node.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 10);
  if (own_hands) joy_ = node.advertise<sensor_msgs::Joy>("joy", 1);
  navvi_config::await_readers(cues_);
}

void Outlets::command(const Velocity& velocity, double lag) {
  if (!ros::Time::isValid()) return;  // without a time it would be the latest of all
  geometry_msgs::TwistStamped command;
  command.header.stamp = ros::Time(std::max(0.0, ros::Time::now().toSec() - lag));
  command.twist = to_msg(velocity);
  commands_.publish(command);
}

void Outlets::send(const core::Output& told) {
  if (told.command) command(*told.command, told.lag);
  if (told.goal) goals_.publish(navvi_types::goal_msg(*told.goal, stamp()));
  if (told.request) requests_.publish(to_msg(navvi_types::TrialRequest{*told.request, stamp()}));
  if (told.rumble_due) motors_.publish(feedback_msg(told.rumble, motors_driver_));
}

void Outlets::send(std::vector<CueEvent> events) {
  for (CueEvent& event : events) {
    event.stamp = stamp();
    cues_.publish(to_msg(event));
    if (event.stage == CueStage::started && event.kind())
      ROS_INFO("[%s] %s", event.word().c_str(), event.text.c_str());
  }
}

void Outlets::send(const drive::InputState& hands) {
  if (joy_) joy_.publish(to_msg(hands, ros::Time::now()));
}

void Outlets::show(const std::optional<CueEvent>& order) {
  CueEvent next = order.value_or(order_);
  if (!order) next.stage = CueStage::ended;
  if (next.stage == order_.stage && next.word() == order_.word() && next.text == order_.text)
    return;
  next.id = order_.id + (order ? 1 : 0);
  next.stamp = stamp();
  order_ = next;
  orders_.publish(to_msg(order_));
}

void Outlets::show(const std::optional<Guidance>& guidance,
                   const std::vector<Eigen::Vector2d>& path,
                   const std::optional<Eigen::Vector2d>& stop, const cues::Phrases& words,
                   double time) {
  if (markers_time_ && time - *markers_time_ < kMarkers) return;
  markers_time_ = time;
  const bool turn = order_.stage == CueStage::started && order_.kind() == CueKind::turn_ahead;
  visualization_msgs::MarkerArray markers =
      picture::guide_markers(guidance, path, words, turn ? order_.text : "", stop);
  if (markers.markers == shown_.markers) return;
  shown_ = markers;
  picture::stamp(markers, ros::Time::now());
  markers_.publish(markers);
}

}  // namespace navvi_feedback::node
