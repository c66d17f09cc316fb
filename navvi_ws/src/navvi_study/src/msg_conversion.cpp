#include "navvi_study/msg_conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace navvi_study {
namespace {

std::int64_t ns(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

template <typename... Numbers>
bool finite(Numbers... numbers) {
  return (std::isfinite(static_cast<double>(numbers)) && ...);
}

template <std::size_t N>
std::string word(const std::array<const char*, N>& words, std::uint8_t index) {
  return index < N ? words[index] : "unknown";
}

}  // namespace

std::optional<OdometryReport> from_msg(const nav_msgs::Odometry& msg) {
  const auto& at = msg.pose.pose.position;
  if (!finite(at.x, at.y)) return std::nullopt;
  return OdometryReport{ns(msg.header.stamp), {at.x, at.y}};
}

std::optional<ContactReport> from_msg(const navvi_msgs::Contact& msg) {
  if (!finite(msg.robot.position.x, msg.robot.position.y, msg.speed) || msg.seq == 0) {
    return std::nullopt;
  }
  ContactReport report{ns(msg.header.stamp),
                       msg.seq,
                       msg.thing_class,
                       msg.name,
                       {msg.robot.position.x, msg.robot.position.y},
                       msg.speed};
  for (const auto& entry : msg.counts) {
    (entry.thing_class == "shelf" ? report.shelf_count : report.obstacle_count) += entry.count;
  }
  return report;
}

std::optional<ProximityReport> from_msg(const navvi_msgs::Proximity& msg) {
  ProximityReport report{ns(msg.header.stamp), {}};
  for (const auto& thing : msg.things) {
    if (!finite(thing.gap, thing.nearest.x, thing.nearest.y)) return std::nullopt;
    report.things.push_back({thing.id, thing.name, thing.thing_class, thing.gap, thing.nearest.y});
  }
  return report;
}

std::optional<GuidanceReport> from_msg(const navvi_msgs::Guidance& msg) {
  static constexpr std::array<const char*, 6> kRefusals = {
      "none", "not_finite", "unknown_frame", "inside_obstacle", "off_the_map", "unreachable"};
  static constexpr std::array<const char*, 8> kReasons = {
      "none",   "new_goal",         "path_carved",   "too_slow",
      "period", "waypoint_blocked", "obstacle_near", "map_changed"};
  if (msg.state > navvi_msgs::Guidance::MAKE_ROOM) return std::nullopt;
  if (!finite(msg.goal.x, msg.goal.y, msg.goal_distance, msg.plan_time)) return std::nullopt;
  GuidanceReport report;
  report.stamp = ns(msg.header.stamp);
  report.seq = msg.seq;
  report.state = static_cast<GuidanceReport::State>(msg.state);
  report.refusal = word(kRefusals, msg.refusal);
  report.replan_reason = word(kReasons, msg.replan_reason);
  report.plans = msg.plans;
  report.plan_time = msg.plan_time;
  report.goal = {msg.goal.x, msg.goal.y};
  report.goal_distance = msg.goal_distance;
  return report;
}

std::optional<CueReport> from_msg(const navvi_msgs::Cue& msg) {
  if (msg.stage > navvi_msgs::Cue::DROPPED) return std::nullopt;
  return CueReport{ns(msg.header.stamp), msg.id, static_cast<CueReport::Stage>(msg.stage),
                   msg.modality == navvi_msgs::Cue::SPEECH, msg.kind};
}

std::optional<DriveReport> from_msg(const navvi_msgs::DriveState& msg) {
  static constexpr std::array<const char*, 3> kReasons = {"none", "command_lost",
                                                          "command_invalid"};
  if (msg.state > navvi_msgs::DriveState::STOPPED) return std::nullopt;
  return DriveReport{ns(msg.header.stamp), msg.state == navvi_msgs::DriveState::STOPPED,
                     word(kReasons, msg.reason)};
}

std::optional<StateReport> from_msg(const navvi_msgs::StateHash& msg) {
  const bool is_hash =
      msg.hash.size() == 16 && msg.hash.find_first_not_of("0123456789abcdef") == msg.hash.npos;
  if (!is_hash) return std::nullopt;
  return StateReport{ns(msg.header.stamp), msg.step, msg.hash};
}

std::optional<ScenarioReport> from_msg(const navvi_msgs::Scenario& msg) {
  if (!finite(msg.goal.x, msg.goal.y)) return std::nullopt;
  return ScenarioReport{msg.world, msg.world_hash, msg.seed, {msg.goal.x, msg.goal.y}};
}

std::vector<DeviceReport> from_msg(const diagnostic_msgs::DiagnosticArray& msg) {
  std::vector<DeviceReport> reports;
  for (const auto& status : msg.status) {
    for (const char* device : {"pad", "audio", "speech"}) {
      const std::string name = std::string("navvi/") + device;
      const auto at = status.name.rfind(name);
      if (at == std::string::npos || at + name.size() != status.name.size()) continue;
      reports.push_back(
          {ns(msg.header.stamp), device, status.level == diagnostic_msgs::DiagnosticStatus::OK});
    }
  }
  return reports;
}

std::vector<Correction> from_msg(const tf2_msgs::TFMessage& msg, bool for_good) {
  std::vector<Correction> corrections;
  for (const auto& entry : msg.transforms) {
    if (entry.header.frame_id != "map" || entry.child_frame_id != "odom") continue;
    const auto& at = entry.transform.translation;
    const auto& turn = entry.transform.rotation;
    if (!finite(at.x, at.y, turn.x, turn.y, turn.z, turn.w)) continue;
    const double yaw = std::atan2(2.0 * (turn.w * turn.z + turn.x * turn.y),
                                  1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z));
    corrections.push_back(
        {for_good ? Correction::kForGood : ns(entry.header.stamp), {at.x, at.y}, yaw});
  }
  return corrections;
}

std::optional<Point2> from_msg(const geometry_msgs::PoseStamped& msg) {
  if (!finite(msg.pose.position.x, msg.pose.position.y)) return std::nullopt;
  return Point2{msg.pose.position.x, msg.pose.position.y};
}

geometry_msgs::PoseStamped goal_msg(const Point2& goal, const ros::Time& stamp) {
  geometry_msgs::PoseStamped msg;
  msg.header.frame_id = "map";
  msg.header.stamp = stamp;
  msg.pose.position.x = goal.x;
  msg.pose.position.y = goal.y;
  msg.pose.orientation.w = 1.0;
  return msg;
}

navvi_msgs::TrialEvent to_msg(const Row& row) {
  navvi_msgs::TrialEvent msg;
  msg.header.stamp.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(0, row.sim_ns)));
  msg.trial = row.trial;
  msg.seq = row.seq;
  msg.type = row.type;
  msg.fields = row.fields.format();
  return msg;
}

std::optional<Row> from_msg(const navvi_msgs::TrialEvent& msg) {
  const auto fields = Fields::parse(msg.fields);
  if (!fields) return std::nullopt;
  return Row{msg.trial, msg.seq, ns(msg.header.stamp), 0, msg.type, *fields};
}

std::optional<HeardSpeech> heard(const navvi_msgs::Cue& msg) {
  if (msg.modality != navvi_msgs::Cue::SPEECH) return std::nullopt;
  switch (msg.stage) {
    case navvi_msgs::Cue::STARTED:
      return HeardSpeech{msg.id, HeardSpeech::Stage::begins, msg.text};
    case navvi_msgs::Cue::ENDED:
      return HeardSpeech{msg.id, HeardSpeech::Stage::ends, msg.text};
    case navvi_msgs::Cue::CUT:
      return HeardSpeech{msg.id, HeardSpeech::Stage::breaks_off, msg.text};
    default:
      return std::nullopt;
  }
}

sensor_msgs::Joy to_msg(const StickAndButtons& hand, const ros::Time& stamp) {
  sensor_msgs::Joy msg;
  msg.header.stamp = stamp;
  msg.axes = {static_cast<float>(hand.left), static_cast<float>(hand.forward)};
  msg.buttons = {hand.repeat ? 1 : 0, 0};
  return msg;
}

}  // namespace navvi_study
