#include "navvi_types/msg_conversion.hpp"

#include <tf2/utils.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <navvi_types/angles.hpp>

#include "navvi_types/limits.hpp"
#include "navvi_types/spoken.hpp"

namespace navvi_types {
namespace {

constexpr double kLevel = 1e-3;  // of a quaternion's x and y

/// False also for a value that is not finite.
bool within(std::initializer_list<double> values, double least, double most) {
  return std::all_of(values.begin(), values.end(),
                     [=](double value) { return value >= least && value <= most; });
}
bool within(std::initializer_list<double> values, double limit) {
  return within(values, -limit, limit);
}
/// -1 stands for none.
bool is_duration_or_none(double duration) {
  return duration == -1.0 || within({duration}, 0.0, kLongestTime);
}
std::optional<double> duration_of(double duration) {
  return duration < 0.0 ? std::nullopt : std::optional(duration);
}

bool valid(const geometry_msgs::Point& point) {
  return within({point.x, point.y, point.z}, kFarthest);
}
bool valid(const geometry_msgs::Quaternion& q) {
  return within({q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0}, kUnitSlack);
}
bool valid(const geometry_msgs::Pose& pose) {
  return valid(pose.position) && valid(pose.orientation);
}

template <typename Enum>
bool is_constant(std::uint8_t number) {
  return from_number<Enum>(number).has_value();
}

ThingClass class_of(const std::string& word) {
  const ThingClass known = from_word<ThingClass>(word).value_or(ThingClass::other);
  return known == ThingClass::floor ? ThingClass::other : known;
}

Eigen::Vector2d flat(const geometry_msgs::Point& point) { return {point.x, point.y}; }

Pose2 pose_of(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Quaternion& q = pose.orientation;
  return {flat(pose.position), tf2::getYaw(tf2::Quaternion(q.x, q.y, q.z, q.w))};
}

template <typename Msg>
Msg stamped(std::int64_t stamp, const std::string& frame = {}) {
  Msg msg;
  msg.header.frame_id = frame;
  msg.header.stamp = from_ns(stamp);
  return msg;
}

/// Copies each field that has one name and one meaning in message and value, one way or the other.
template <typename From, typename To>
void copy_guidance(const From& from, To& to) {
  const auto copy = [](const auto& source, auto& target) {
    target = static_cast<std::decay_t<decltype(target)>>(source);
  };
  copy(from.seq, to.seq);
  copy(from.state, to.state);
  copy(from.refusal, to.refusal);
  copy(from.replan_reason, to.replan_reason);
  copy(from.plans, to.plans);
  copy(from.plan_time, to.plan_time);
  copy(from.reroutes, to.reroutes);
  copy(from.reroute_reason, to.reroute_reason);
  copy(from.blocked_distance, to.blocked_distance);
  copy(from.ends_short, to.ends_short);
  copy(from.waypoint_is_goal, to.waypoint_is_goal);
  copy(from.waypoint_distance, to.waypoint_distance);
  copy(from.waypoint_angle, to.waypoint_angle);
  copy(from.steer_angle, to.steer_angle);
  copy(from.turn_angle, to.turn_angle);
  copy(from.goal_distance, to.goal_distance);
  copy(from.eta, to.eta);
  copy(from.shortest_length, to.shortest_length);
  copy(from.path_offset, to.path_offset);
  copy(from.detail, to.detail);
}

}  // namespace

geometry_msgs::Point point_msg(const Eigen::Vector2d& point, double z) {
  geometry_msgs::Point msg;
  msg.x = point.x();
  msg.y = point.y();
  msg.z = z;
  return msg;
}

geometry_msgs::Pose pose_msg(const Pose2& pose, double z) {
  geometry_msgs::Pose msg;
  msg.position = point_msg(pose.position, z);
  msg.orientation.z = std::sin(0.5 * pose.yaw);
  msg.orientation.w = std::cos(0.5 * pose.yaw);
  return msg;
}

std::optional<Velocity> from_msg(const geometry_msgs::Twist& msg) {
  const geometry_msgs::Vector3 &linear = msg.linear, &angular = msg.angular;
  if (!within({linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}, kFastest))
    return std::nullopt;
  return Velocity{linear.x, angular.z};
}

std::optional<Pose2> from_msg(const geometry_msgs::Transform& msg) {
  geometry_msgs::Pose pose;
  pose.position.x = msg.translation.x;
  pose.position.y = msg.translation.y;
  pose.position.z = msg.translation.z;
  pose.orientation = msg.rotation;
  return valid(pose) ? std::optional(pose_of(pose)) : std::nullopt;
}

std::optional<Eigen::Vector2d> from_msg(const geometry_msgs::PoseStamped& msg) {
  const geometry_msgs::Quaternion& q = msg.pose.orientation;
  if (!valid(msg.pose.position) || !std::isfinite(q.x + q.y + q.z + q.w)) return std::nullopt;
  return flat(msg.pose.position);
}

std::optional<Eigen::Vector2d> from_msg(const geometry_msgs::PointStamped& msg) {
  return valid(msg.point) ? std::optional(flat(msg.point)) : std::nullopt;
}

Checked<Odometry> from_msg(const nav_msgs::Odometry& msg) {
  const std::optional<Velocity> velocity = from_msg(msg.twist.twist);
  if (!velocity) return Refusal{"its twist is not finite, or beyond 100 m/s or rad/s"};
  if (!valid(msg.pose.pose.position))
    return Refusal{"its position is not finite, or beyond 100 km"};
  if (!valid(msg.pose.pose.orientation))
    return Refusal{"the norm of its orientation's quaternion is not 1"};
  return Odometry{to_ns(msg.header.stamp), pose_of(msg.pose.pose), *velocity,
                  msg.twist.twist.linear.y, msg.pose.pose.position.z};
}

Checked<Pose2> origin_of(const nav_msgs::OccupancyGrid& msg) {
  geometry_msgs::Pose origin = msg.info.origin;
  geometry_msgs::Quaternion& q = origin.orientation;
  if (q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0) q.w = 1.0;
  if (!valid(origin.position)) return Refusal{"its origin is not finite, or beyond 100 km"};
  if (!valid(q)) return Refusal{"the norm of its origin's quaternion is not 1 (or 0 for no turn)"};
  if (!within({q.x, q.y}, kLevel)) return Refusal{"its origin is tilted: a map lies flat"};
  return pose_of(origin);
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

std::optional<Proximity> from_msg(const navvi_msgs::Proximity& msg) {
  if (!within({msg.detection_radius}, 0.0, kLongest) || msg.detection_radius == 0.0 ||
      msg.things.size() > kMostThings)
    return std::nullopt;
  Proximity proximity{to_ns(msg.header.stamp), {}, msg.detection_radius};
  proximity.things.reserve(msg.things.size());
  for (const navvi_msgs::ProximityThing& thing : msg.things) {
    if (!within({thing.gap}, kLongest) || !valid(thing.nearest)) return std::nullopt;
    proximity.things.push_back({class_of(thing.thing_class), thing.id, thing.gap,
                                flat(thing.nearest), thing.moving != 0, thing.name,
                                thing.nearest.z});
  }
  return proximity;
}

std::optional<Contact> from_msg(const navvi_msgs::Contact& msg) {
  if (msg.seq == 0 || !valid(msg.point) || !valid(msg.robot) || !within({msg.speed}, kFastest) ||
      msg.counts.size() > kMostThings)
    return std::nullopt;
  Contact contact{class_of(msg.thing_class), flat(msg.point),      msg.id,    msg.name, msg.point.z,
                  pose_of(msg.robot),        msg.robot.position.z, msg.speed, {},       msg.seq,
                  to_ns(msg.header.stamp)};
  for (const navvi_msgs::ClassCount& entry : msg.counts)
    contact.counts[class_of(entry.thing_class)] += entry.count;
  return contact;
}

std::optional<Obstacles> from_msg(const navvi_msgs::Obstacles& msg) {
  if (msg.obstacles.size() > kMostThings) return std::nullopt;
  Obstacles obstacles{to_ns(msg.header.stamp), {}};
  obstacles.things.reserve(msg.obstacles.size());
  std::vector<std::uint32_t> ids;
  ids.reserve(msg.obstacles.size());
  for (const navvi_msgs::Obstacle& entry : msg.obstacles) {
    const geometry_msgs::Vector3& velocity = entry.velocity;
    if (!valid(entry.pose) || !within({velocity.x, velocity.y, velocity.z}, kFastest) ||
        !within({entry.radius, entry.height}, 0.0, kLargest) || entry.radius == 0.0 ||
        entry.height == 0.0)
      return std::nullopt;
    ids.push_back(entry.id);
    const MovingThing thing{entry.id,
                            class_of(entry.thing_class),
                            pose_of(entry.pose),
                            {velocity.x, velocity.y},
                            entry.radius,
                            entry.height,
                            entry.length,
                            entry.width,
                            entry.pose.position.z};
    if (!thing.sound()) return std::nullopt;
    obstacles.things.push_back(thing);
  }
  std::sort(ids.begin(), ids.end());
  if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) return std::nullopt;
  return obstacles;
}

std::optional<Guidance> from_msg(const navvi_msgs::Guidance& msg) {
  const bool sound =
      is_constant<Guidance::State>(msg.state) && is_constant<Guidance::Refusal>(msg.refusal) &&
      is_constant<Guidance::Replan>(msg.replan_reason) &&
      is_constant<Guidance::Replan>(msg.reroute_reason) && valid(msg.goal) && valid(msg.waypoint) &&
      within({msg.plan_time, msg.eta}, 0.0, kLongestTime) && is_duration_or_none(msg.mesh_age) &&
      is_duration_or_none(msg.map_age) && is_duration_or_none(msg.blocked_for) &&
      within({msg.blocked_distance, msg.waypoint_distance, msg.goal_distance, msg.shortest_length,
              msg.path_offset},
             0.0, kLongest) &&
      within({msg.waypoint_angle, msg.steer_angle, msg.turn_angle}, kPi + kRounding);
  if (!sound) return std::nullopt;
  Guidance guidance;
  copy_guidance(msg, guidance);
  guidance.stamp = to_ns(msg.header.stamp);
  guidance.mesh_age = duration_of(msg.mesh_age);
  guidance.map_age = duration_of(msg.map_age);
  if (!msg.blocked_by.empty()) guidance.blocked_by = class_of(msg.blocked_by);
  guidance.blocked_for = duration_of(msg.blocked_for);
  guidance.goal = flat(msg.goal);
  guidance.waypoint = flat(msg.waypoint);
  guidance.floor = msg.waypoint.z;
  return guidance;
}

std::optional<CueEvent> from_msg(const navvi_msgs::Cue& msg) {
  if (!is_constant<CueStage>(msg.stage) || !is_constant<Modality>(msg.modality) ||
      !is_constant<Priority>(msg.priority) ||
      !within({msg.left, msg.right}, -kRounding, 1.0 + kRounding))
    return std::nullopt;
  const auto what = signal_of(static_cast<Modality>(msg.modality), msg.kind);
  if (!what) return std::nullopt;
  return CueEvent{msg.id,
                  static_cast<CueStage>(msg.stage),
                  *what,
                  msg.text,
                  static_cast<Priority>(msg.priority),
                  static_cast<double>(msg.left),
                  static_cast<double>(msg.right),
                  to_ns(msg.header.stamp)};
}

std::optional<DriveState> from_msg(const navvi_msgs::DriveState& msg) {
  const auto state = from_number<DriveState::State>(msg.state);
  const auto reason = from_number<DriveState::Reason>(msg.reason);
  const auto assistance = from_number<DriveState::Assistance>(msg.assistance);
  if (!state || !reason || !assistance) return std::nullopt;
  return DriveState{*state,       *reason,    msg.rejected, to_ns(msg.header.stamp),
                    msg.intruder, *assistance};
}

std::optional<LinkState> from_msg(const navvi_msgs::LinkState& msg) {
  const auto late = from_number<LinkState::Late>(msg.late);
  if (!late || !within({msg.round_trip, msg.round_trip_99, msg.jitter, msg.foresight}, 0.0, kLongestTime) ||
      !within({msg.loss}, 0.0, 1.0))
    return std::nullopt;
  return LinkState{msg.round_trip, msg.round_trip_99, msg.jitter,
                   msg.loss,       msg.foresight,     *late,
                   to_ns(msg.header.stamp)};
}

std::optional<ZoneState> from_msg(const navvi_msgs::Zone& msg) {
  const auto kind = from_number<ZoneState::Kind>(msg.kind);
  if (!kind || !within({msg.forward, msg.backward}, 0.0, kFastest) ||
      (*kind != ZoneState::Kind::none && !is_place_name(msg.name)))
    return std::nullopt;
  return ZoneState{*kind, msg.name, msg.forward, msg.backward, to_ns(msg.header.stamp)};
}

std::optional<Scenario> from_msg(const navvi_msgs::Scenario& msg) {
  if (!valid(msg.start) || !valid(msg.goal)) return std::nullopt;
  std::vector<Place> places;
  for (const navvi_msgs::Place& place : msg.places) {
    const auto kind = from_number<Place::Kind>(place.kind);
    if (!kind || place.number == 0 || !valid(place.at) || !valid(place.low) || !valid(place.high))
      return std::nullopt;
    places.push_back({*kind, place.number, flat(place.at), {flat(place.low), flat(place.high)}});
  }
  return Scenario{msg.world,      msg.world_hash,     msg.seed,
                  flat(msg.goal), pose_of(msg.start), msg.start.position.z,
                  places,         msg.parameters,     to_ns(msg.header.stamp)};
}

std::optional<StateHash> from_msg(const navvi_msgs::StateHash& msg) {
  if (msg.hash.size() != 16 || msg.hash.find_first_not_of("0123456789abcdef") != msg.hash.npos)
    return std::nullopt;
  StateHash state{to_ns(msg.header.stamp), msg.step, 0};
  std::from_chars(msg.hash.data(), msg.hash.data() + msg.hash.size(), state.hash, 16);
  return state;
}

std::optional<TrialState> from_msg(const navvi_msgs::TrialState& msg) {
  const auto state = from_number<TrialState::State>(msg.state);
  const auto task = from_number<TrialState::Task>(msg.task);
  if (!state || !task) return std::nullopt;
  return TrialState{*state, to_ns(msg.header.stamp), msg.place, *task};
}

std::optional<TrialRequest> from_msg(const navvi_msgs::TrialRequest& msg) {
  const auto kind = from_number<TrialRequest::Kind>(msg.request);
  return kind ? std::optional(TrialRequest{*kind, to_ns(msg.header.stamp)}) : std::nullopt;
}

geometry_msgs::Twist to_msg(const Velocity& velocity) {
  geometry_msgs::Twist msg;
  msg.linear.x = velocity.linear;
  msg.angular.z = velocity.angular;
  return msg;
}

nav_msgs::Odometry to_msg(const Odometry& odometry) {
  auto msg = stamped<nav_msgs::Odometry>(odometry.stamp, "odom");
  msg.child_frame_id = "base_link";
  msg.pose.pose = pose_msg(odometry.pose, odometry.floor);
  msg.twist.twist = to_msg(odometry.velocity);
  msg.twist.twist.linear.y = odometry.sideways;
  return msg;
}

navvi_msgs::Proximity to_msg(const Proximity& proximity) {
  auto msg = stamped<navvi_msgs::Proximity>(proximity.stamp, "base_link");
  msg.detection_radius = proximity.detection_radius;
  msg.things.reserve(proximity.things.size());
  for (const NearThing& thing : proximity.things) {
    navvi_msgs::ProximityThing& entry = msg.things.emplace_back();
    entry.id = thing.id;
    entry.name = thing.name;
    entry.thing_class = to_string(thing.thing_class);
    entry.moving = thing.moving;
    entry.gap = thing.gap;
    entry.nearest = point_msg(thing.nearest, thing.height);
  }
  return msg;
}

navvi_msgs::Contact to_msg(const Contact& contact) {
  auto msg = stamped<navvi_msgs::Contact>(contact.stamp, "map");
  msg.seq = contact.seq;
  msg.id = contact.id;
  msg.name = contact.name;
  msg.thing_class = to_string(contact.thing_class);
  msg.point = point_msg(contact.point, contact.height);
  msg.robot = pose_msg(contact.robot, contact.floor);
  msg.speed = contact.speed;
  for (const auto& [thing_class, count] : contact.counts) {
    navvi_msgs::ClassCount& entry = msg.counts.emplace_back();
    entry.thing_class = to_string(thing_class);
    entry.count = count;
  }
  return msg;
}

navvi_msgs::Obstacles to_msg(const Obstacles& obstacles) {
  auto msg = stamped<navvi_msgs::Obstacles>(obstacles.stamp, "map");
  msg.obstacles.reserve(obstacles.things.size());
  for (const MovingThing& thing : obstacles.things) {
    navvi_msgs::Obstacle& entry = msg.obstacles.emplace_back();
    entry.id = thing.id;
    entry.thing_class = to_string(thing.thing_class);
    entry.pose = pose_msg(thing.pose, thing.floor);
    entry.velocity.x = thing.velocity.x();
    entry.velocity.y = thing.velocity.y();
    entry.radius = thing.radius;
    entry.height = thing.height;
    entry.length = thing.length;
    entry.width = thing.width;
  }
  return msg;
}

navvi_msgs::Guidance to_msg(const Guidance& guidance) {
  auto msg = stamped<navvi_msgs::Guidance>(guidance.stamp, "map");
  copy_guidance(guidance, msg);
  msg.mesh_age = guidance.mesh_age.value_or(-1.0);
  msg.map_age = guidance.map_age.value_or(-1.0);
  if (guidance.blocked_by) msg.blocked_by = to_string(*guidance.blocked_by);
  msg.blocked_for = guidance.blocked_for.value_or(-1.0);
  msg.goal = point_msg(guidance.goal, guidance.floor);
  msg.waypoint = point_msg(guidance.waypoint, guidance.floor);
  return msg;
}

navvi_msgs::Cue to_msg(const CueEvent& event) {
  auto msg = stamped<navvi_msgs::Cue>(event.stamp);
  msg.id = event.id;
  msg.stage = static_cast<std::uint8_t>(event.stage);
  msg.modality = static_cast<std::uint8_t>(event.modality());
  msg.priority = static_cast<std::uint8_t>(event.priority);
  msg.kind = event.word();
  msg.text = event.text;
  msg.left = static_cast<float>(event.left);
  msg.right = static_cast<float>(event.right);
  return msg;
}

navvi_msgs::DriveState to_msg(const DriveState& state) {
  auto msg = stamped<navvi_msgs::DriveState>(state.stamp);
  msg.state = static_cast<std::uint8_t>(state.state);
  msg.reason = static_cast<std::uint8_t>(state.reason);
  msg.rejected = state.rejected;
  msg.intruder = state.intruder;
  msg.assistance = static_cast<std::uint8_t>(state.assistance);
  return msg;
}

navvi_msgs::LinkState to_msg(const LinkState& state) {
  auto msg = stamped<navvi_msgs::LinkState>(state.stamp);
  msg.round_trip = state.round_trip;
  msg.round_trip_99 = state.round_trip_99;
  msg.jitter = state.jitter;
  msg.loss = state.loss;
  msg.foresight = state.foresight;
  msg.late = static_cast<std::uint8_t>(state.late);
  return msg;
}

navvi_msgs::Zone to_msg(const ZoneState& state) {
  auto msg = stamped<navvi_msgs::Zone>(state.stamp, "map");
  msg.kind = static_cast<std::uint8_t>(state.kind);
  msg.name = state.name;
  msg.forward = state.forward;
  msg.backward = state.backward;
  return msg;
}

navvi_msgs::Scenario to_msg(const Scenario& scenario) {
  auto msg = stamped<navvi_msgs::Scenario>(scenario.stamp, "map");
  msg.world = scenario.world;
  msg.world_hash = scenario.world_hash;
  msg.seed = scenario.seed;
  msg.start = pose_msg(scenario.start, scenario.floor);
  msg.goal = point_msg(scenario.goal, scenario.floor);
  for (const Place& place : scenario.places) {
    navvi_msgs::Place one;
    one.kind = static_cast<std::uint8_t>(place.kind);
    one.number = place.number;
    one.at = point_msg(place.at, scenario.floor);
    one.low = point_msg(place.area.min(), scenario.floor);
    one.high = point_msg(place.area.max(), scenario.floor);
    msg.places.push_back(one);
  }
  msg.parameters = scenario.parameters;
  return msg;
}

navvi_msgs::TrialState to_msg(const TrialState& state) {
  auto msg = stamped<navvi_msgs::TrialState>(state.stamp);
  msg.state = static_cast<std::uint8_t>(state.state);
  msg.place = state.place;
  msg.task = static_cast<std::uint8_t>(state.task);
  return msg;
}

navvi_msgs::TrialRequest to_msg(const TrialRequest& request) {
  auto msg = stamped<navvi_msgs::TrialRequest>(request.stamp);
  msg.request = static_cast<std::uint8_t>(request.kind);
  return msg;
}

navvi_msgs::StateHash to_msg(const StateHash& state) {
  auto msg = stamped<navvi_msgs::StateHash>(state.stamp, "map");
  msg.step = state.step;
  msg.hash = to_hex(state.hash);
  return msg;
}

nav_msgs::Path path_msg(const std::vector<Eigen::Vector2d>& points, double floor,
                        std::int64_t stamp, const std::string& frame) {
  auto msg = stamped<nav_msgs::Path>(stamp, frame);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t from = i + 1 < points.size() ? i : i - 1;
    Eigen::Vector2d leg = Eigen::Vector2d::UnitX();
    if (points.size() > 1) leg = points[from + 1] - points[from];
    geometry_msgs::PoseStamped& pose = msg.poses.emplace_back();
    pose.header = msg.header;
    pose.pose = pose_msg({points[i], std::atan2(leg.y(), leg.x())}, floor);
  }
  return msg;
}

geometry_msgs::PoseStamped goal_msg(const Eigen::Vector2d& goal, std::int64_t stamp) {
  auto msg = stamped<geometry_msgs::PoseStamped>(stamp, "map");
  msg.pose = pose_msg({goal, 0.0}, 0.0);
  return msg;
}

std::int64_t to_ns(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

ros::Time from_ns(std::int64_t ns) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(0, ns)));
}

}  // namespace navvi_types
