#include "senses/senses.hpp"

#include <utility>

namespace navvi_feedback::senses {
namespace {

constexpr double kSilent = 0.6;      // s; the connection's state comes twice a second
constexpr double kSlow = 0.3;        // s, of a round trip, from which on people drive worse
constexpr double kNotSlow = 0.25;    // s, from which on it is not slow any more
constexpr double kRecordLost = 2.0;  // s; a slow disk holds trial_node up for less
constexpr double kHoldLost = 6.0;    // s, likewise between trials, where more is written

/// The smallest place that holds the point.
std::optional<navvi_types::Place> place_at(const navvi_types::Scenario& scenario,
                                           const Eigen::Vector2d& point) {
  std::optional<navvi_types::Place> found;
  for (const navvi_types::Place& place : scenario.places)
    if (place.area.contains(point) && (!found || place.area.volume() < found->area.volume()))
      found = place;
  return found;
}

}  // namespace

void Senses::take(const Guidance& guidance, double time) {
  guidance_ = {guidance, time};
  turned_ = 0.0;
}

void Senses::take(const DriveState& state, double /*time*/) {
  gate_ = state.state;
  assistance_ = state.assistance;
  intruder_ = !state.intruder.empty();
  emergency_stop_ = state.reason == DriveState::Reason::emergency_stop;
}

void Senses::take(const TrialState& state, double time) {
  trial_repeats_ = trial_time_ && state.state == trial_.state;
  trial_time_ = time;
  trial_ = state;
}

Observation Senses::observe(const Devices& devices, double dt, double time) {
  Observation now;
  now.devices = devices;
  seen_hands_ = seen_hands_ || devices.hands.live;
  if (motion_.value) turned_ += motion_.value->angular * dt;
  now.links = links(devices, time);
  now.simulated = scenario_.has_value();
  if (now.links.simulator == Link::alive) now.measured = motion_.value;
  now.last_measured = motion_.value.value_or(Velocity{});
  now.gate = gate_;
  now.assistance = assistance_;
  if (now.links.proximity == Link::alive) now.nearby = *nearby_.value;
  now.contacts = std::exchange(contacts_, {});
  if (connection_.value) {
    now.connection = *connection_.value;
    // A robot whose motion alone is silent still tells of the way.
    const auto silent = [&](const auto& latest) {
      return latest.link(time, kSilent) != Link::alive;
    };
    now.cut_off = silent(motion_) && silent(guidance_) && silent(connection_);
    slow_ = now.connection.late != LinkState::Late::no ||
            now.connection.round_trip > (slow_ ? kNotSlow : kSlow);
  }
  now.guidance = guidance_.value;
  now.turned = turned_;
  if (devices.robot) locate(now);
  now.trial = trial_.holds() && !holds(time) ? TrialState::State::free : trial_.state;
  now.task = trial_.task;
  now.reached = trial_.place;
  now.notices = devices.states;
  now.zone = zone_.name;
  if (zone_.kind != ZoneState::Kind::none)
    now.notices.emplace_back(CueKind::notice,
                             navvi_types::from_word<About>("zone_" + std::string(to_string(zone_.kind))).value());
  if (slow_) now.notices.emplace_back(CueKind::notice, About::connection_slow);
  if (assistance_ != DriveState::Assistance::nothing) now.notices.push_back(CueKind::assisted);
  if (intruder_) now.notices.emplace_back(CueKind::notice, About::intruder);
  if (emergency_stop_) now.notices.push_back(CueKind::emergency_stop);
  if (record_lost(time)) now.notices.push_back(CueKind::record_lost);
  return now;
}

Links Senses::links(const Devices& devices, double time) const {
  const bool there = devices.hands.live || devices.hands.late;
  const Link pad = there ? Link::alive : seen_hands_ ? Link::lost : Link::never;
  return {pad, motion_.link(time, stale_), nearby_.link(time, stale_), guidance_.link(time, stale_),
          devices.audio};
}

bool Senses::record_lost(double time) const {
  const double longest = trial_.holds() ? kHoldLost : kRecordLost;
  return trial_.state != TrialState::State::free && trial_repeats_ && time - *trial_time_ > longest;
}

/// Place and goal as the robot has them about it.
void Senses::locate(Observation& now) const {
  const navvi_types::Pose2& robot = *now.devices.robot;
  if (scenario_) now.place = place_at(*scenario_, robot.position);
  if (!now.guidance || !now.guidance->leads()) return;
  now.goal_angle = navvi_types::clockwise_angle(robot, now.guidance->goal);
  now.goal_straight = (now.guidance->goal - robot.position).norm();
}

}  // namespace navvi_feedback::senses
