#include "navvi_feedback/msg_conversion.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <initializer_list>

namespace navvi_feedback {
namespace {

constexpr double kFarthest = 1e6;    // m; nothing is farther away
constexpr double kFastest = 1e3;     // m/s, rad/s
constexpr double kAxisSlack = 1e-3;  // of an axis beyond [-1, 1]
constexpr double kUnitSlack = 1e-2;  // of a quaternion's norm
constexpr std::size_t kMostThings = 10000;
constexpr std::size_t kMostPoints = 100000;

bool all_within(double limit, std::initializer_list<double> values) {
  for (const double value : values) {
    if (!std::isfinite(value) || std::abs(value) > limit) return false;
  }
  return true;
}

bool valid(const geometry_msgs::Point& point) {
  return all_within(kFarthest, {point.x, point.y, point.z});
}

bool valid(const geometry_msgs::Quaternion& q) {
  if (!all_within(2.0, {q.x, q.y, q.z, q.w})) return false;
  return std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) <= kUnitSlack;
}

double yaw_of(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

ThingClass class_of(const std::string& word) {
  return thing_class_from(word).value_or(ThingClass::other);
}

Eigen::Vector2d flat(const geometry_msgs::Point& point) { return {point.x, point.y}; }

}  // namespace

std::optional<std::vector<Nearby>> from_msg(const navvi_msgs::Proximity& msg) {
  if (!all_within(kFarthest, {msg.detection_radius}) || msg.detection_radius <= 0.0 ||
      msg.things.size() > kMostThings) {
    return std::nullopt;
  }
  std::vector<Nearby> things;
  things.reserve(msg.things.size());
  for (const navvi_msgs::ProximityThing& thing : msg.things) {
    if (!all_within(kFarthest, {thing.gap}) || !valid(thing.nearest)) return std::nullopt;
    things.push_back(Nearby{class_of(thing.thing_class), thing.id, thing.gap, flat(thing.nearest),
                            thing.moving != 0});
  }
  return things;
}

std::optional<Situation::Contact> from_msg(const navvi_msgs::Contact& msg) {
  if (!valid(msg.point) || !valid(msg.robot.position) || !valid(msg.robot.orientation) ||
      !all_within(kFastest, {msg.speed})) {
    return std::nullopt;
  }
  const Eigen::Rotation2Dd into_robot(-yaw_of(msg.robot.orientation));
  return Situation::Contact{class_of(msg.thing_class),
                            into_robot * (flat(msg.point) - flat(msg.robot.position)), msg.id};
}

std::optional<Guidance> from_msg(const navvi_msgs::Guidance& msg) {
  constexpr double kAngle = M_PI + 1e-6;
  const bool in_range = msg.state <= navvi_msgs::Guidance::MAKE_ROOM &&
                        msg.refusal <= navvi_msgs::Guidance::UNREACHABLE &&
                        msg.replan_reason <= navvi_msgs::Guidance::MAP_CHANGED &&
                        msg.reroute_reason <= navvi_msgs::Guidance::MAP_CHANGED;
  if (!in_range || !valid(msg.goal) || !valid(msg.waypoint) ||
      !all_within(kAngle, {msg.waypoint_angle, msg.steer_angle, msg.turn_angle}) ||
      !all_within(kFarthest, {msg.waypoint_distance, msg.goal_distance, msg.path_offset}) ||
      msg.waypoint_distance < 0.0 || msg.goal_distance < 0.0 || msg.path_offset < 0.0) {
    return std::nullopt;
  }
  Guidance guidance;
  guidance.seq = msg.seq;
  guidance.state = static_cast<Guidance::State>(msg.state);
  guidance.refusal = static_cast<Guidance::Refusal>(msg.refusal);
  guidance.replan_reason = static_cast<Guidance::Replan>(msg.replan_reason);
  guidance.reroutes = msg.reroutes;
  guidance.reroute_reason = static_cast<Guidance::Replan>(msg.reroute_reason);
  guidance.blocked_by = class_of(msg.blocked_by);
  guidance.goal = flat(msg.goal);
  guidance.waypoint = flat(msg.waypoint);
  guidance.floor = msg.waypoint.z;
  guidance.waypoint_is_goal = msg.waypoint_is_goal != 0;
  guidance.waypoint_distance = msg.waypoint_distance;
  guidance.waypoint_angle = msg.waypoint_angle;
  guidance.steer_angle = msg.steer_angle;
  guidance.turn_angle = msg.turn_angle;
  guidance.goal_distance = msg.goal_distance;
  guidance.path_offset = msg.path_offset;
  return guidance;
}

std::optional<Situation::Gate> from_msg(const navvi_msgs::DriveState& msg) {
  switch (msg.state) {
    case navvi_msgs::DriveState::WAITING:
      return Situation::Gate::waiting;
    case navvi_msgs::DriveState::RUNNING:
      return Situation::Gate::running;
    case navvi_msgs::DriveState::STOPPED:
      return Situation::Gate::stopped;
    default:
      return std::nullopt;
  }
}

std::optional<Situation::Motion> from_msg(const nav_msgs::Odometry& msg) {
  const auto& twist = msg.twist.twist;
  if (!all_within(kFastest, {twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x,
                             twist.angular.y, twist.angular.z}) ||
      !valid(msg.pose.pose.position) || !valid(msg.pose.pose.orientation)) {
    return std::nullopt;
  }
  return Situation::Motion{twist.linear.x, twist.angular.z};
}

std::optional<std::vector<Eigen::Vector2d>> from_msg(const nav_msgs::Path& msg) {
  if (msg.poses.size() > kMostPoints) return std::nullopt;
  std::vector<Eigen::Vector2d> points;
  points.reserve(msg.poses.size());
  for (const geometry_msgs::PoseStamped& pose : msg.poses) {
    if (!valid(pose.pose.position)) return std::nullopt;
    points.push_back(flat(pose.pose.position));
  }
  return points;
}

std::optional<InputState> from_msg(const sensor_msgs::Joy& msg) {
  if (msg.axes.size() < 2 || msg.axes.size() > 64 || msg.buttons.size() > 256) return std::nullopt;
  InputState input;
  input.live = true;
  for (const float axis : msg.axes) {
    if (!all_within(1.0 + kAxisSlack, {static_cast<double>(axis)})) return std::nullopt;
    input.axes.push_back(static_cast<double>(axis));
  }
  for (const int button : msg.buttons) input.buttons.push_back(button != 0);
  return input;
}

std::optional<double> angle_to(const geometry_msgs::Transform& robot,
                               const Eigen::Vector2d& target) {
  const geometry_msgs::Vector3& from = robot.translation;
  if (!all_within(kFarthest, {from.x, from.y, from.z}) || !valid(robot.rotation) ||
      !target.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Vector2d seen =
      Eigen::Rotation2Dd(-yaw_of(robot.rotation)) * (target - Eigen::Vector2d(from.x, from.y));
  return -std::atan2(seen.y(), seen.x());
}

sensor_msgs::Joy to_msg(const InputState& input, const ros::Time& stamp) {
  sensor_msgs::Joy msg;
  msg.header.stamp = stamp;
  for (const double axis : input.axes) msg.axes.push_back(static_cast<float>(axis));
  for (const bool button : input.buttons) msg.buttons.push_back(button ? 1 : 0);
  return msg;
}

sensor_msgs::JoyFeedbackArray feedback_msg(const Rumble& rumble) {
  sensor_msgs::JoyFeedbackArray msg;
  msg.array.resize(2);
  for (std::uint8_t id = 0; id < 2; ++id) {
    msg.array[id].type = sensor_msgs::JoyFeedback::TYPE_RUMBLE;
    msg.array[id].id = id;
    msg.array[id].intensity = static_cast<float>(id == 0 ? rumble.left : rumble.right);
  }
  return msg;
}

navvi_msgs::Cue to_msg(const CueEvent& event, const ros::Time& stamp) {
  navvi_msgs::Cue msg;
  msg.header.stamp = stamp;
  msg.id = event.id;
  msg.stage = static_cast<std::uint8_t>(event.stage);
  msg.modality = navvi_msgs::Cue::SPEECH;
  msg.priority = static_cast<std::uint8_t>(event.cue.priority);
  msg.kind = event.cue.kind;
  msg.text = event.cue.text;
  return msg;
}

navvi_msgs::Cue rumble_msg(const Rumble& rumble, std::uint32_t id, const ros::Time& stamp) {
  navvi_msgs::Cue msg;
  msg.header.stamp = stamp;
  msg.id = id;
  msg.stage = navvi_msgs::Cue::STARTED;
  msg.modality = navvi_msgs::Cue::RUMBLE;
  msg.priority = navvi_msgs::Cue::PROGRESS;
  msg.kind = "rumble";
  msg.left = static_cast<float>(rumble.left);
  msg.right = static_cast<float>(rumble.right);
  return msg;
}

}  // namespace navvi_feedback
