#include "batch/loop_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <navvi_types/angles.hpp>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_study::batch {
namespace {

using navvi_types::CueKind;

constexpr double kNearby = 1.5;    // m; what is farther away does not hold a robot up
constexpr double kAnswered = 1.0;  // s, within which a question is answered

std::string metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f m", value);
  return text.data();
}

bool asks_to_turn(const navvi_types::CueEvent& cue) {
  if (cue.kind()) return traits(*cue.kind()).ask == navvi_types::Ask::turn;
  return cue.word() == to_string(navvi_types::Earcon::turn);
}

}  // namespace

bool LoopFigures::watch(const ClosedLoop& loop) {
  const ClosedLoop::Messages& told = loop.told();
  if (!begun_ && loop.begun()) begin(loop);
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  // Where the robot truly is, which the odometry may not know.
  if (const auto place = navvi_types::from_msg(
          navvi_types::to_msg(robot.odometry(0.0, loop.session().world().now().stamp()))))
    (void)monitor_.observe(*place);
  for (const auto& contact : told.contacts) {
    if (const auto report = navvi_types::from_msg(contact)) (void)monitor_.observe(*report);
    if (begun_) ++hits_[contact.thing_class];
    if (begun_) warnings_.touch(contact, loop.time());
  }
  if (told.proximity) {
    if (const auto report = navvi_types::from_msg(*told.proximity)) (void)monitor_.observe(*report);
    warnings_.feel(*told.proximity, loop.time());
    feel(*told.proximity);
  }
  if (loop.hand().repeat) asked_ = loop.time();
  for (const auto& cue : told.cues) {
    const auto report = navvi_types::from_msg(cue);
    if (report) (void)monitor_.observe(*report);
    if (report && begun_) speech_.hear(*report, loop.time() - asked_ < kAnswered, loop.time());
    if (!report || report->stage != navvi_types::CueStage::started) continue;
    if (begun_) directions_.hear(loop, *report, monitor_.tally().path_length);
    if (begun_ && report->kind()) about_.spoken = report->text;
    if (asks_to_turn(*report)) turns_made_.ask(loop.time());
    warnings_.hear(*report, loop.time());
    stands_.hear();
  }
  if (told.guidance) {
    if (const auto report = navvi_types::from_msg(*told.guidance)) {
      (void)monitor_.observe(*report);
      about_.state = report->state;
      course_.reset();
      if (report->is_followed()) course_ = robot.yaw - report->steer_angle;
    }
    if (begun_) take(*told.guidance);
  }
  if (!begun_) return true;
  sensing_.watch(loop);
  time_ = loop.time() - *begun_;
  states_[to_string(about_.state)] += loop.dt();
  if (told.motors.left > 0.0 || told.motors.right > 0.0) felt_for_ += loop.dt();
  judge_turns(loop);
  stands_.watch(loop, time_, about_.text());
  if (monitor_.reached()) result_ = "reached";
  if (loop.person().gave_up()) result_ = "gave_up";
  if (monitor_.refused()) result_ = "refused: " + *monitor_.refused();
  return result_ == "timeout" && time_ < limit_;
}

void LoopFigures::feel(const navvi_msgs::Proximity& near) {
  about_.nearest.clear();
  if (near.things.empty()) return;
  const auto& nearest = near.things.front();
  if (begun_) least_gap_ = std::min(least_gap_, nearest.gap);
  if (nearest.gap < kNearby) about_.nearest = nearest.thing_class + " at " + metres(nearest.gap);
}

void LoopFigures::begin(const ClosedLoop& loop) {
  begun_ = loop.time();
  const Eigen::Vector2d& goal = loop.scenario().goal;
  const auto stamp = static_cast<std::int64_t>(std::llround(loop.time() * 1e9));
  monitor_.start(monitor_.start_now(stamp, goal));
  stands_.begin(loop.session().world().now().robot.position);
}

void LoopFigures::take(const navvi_msgs::Guidance& guidance) {
  about_.blocked_by = guidance.blocked_by;
  reroutes_ = std::max(reroutes_, guidance.reroutes);
  if (shortest_ == 0.0) shortest_ = guidance.shortest_length;
}

void LoopFigures::judge_turns(const ClosedLoop& loop) {
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  std::optional<double> off;
  if (course_) off = navvi_types::wrap(robot.yaw - *course_);
  turns_made_.watch(robot.turn_rate, robot.forward_speed(), off, loop.time());
}

std::string LoopFigures::About::text() const {
  std::string text = to_string(state);
  if (!blocked_by.empty()) text += " by " + blocked_by;
  if (!nearest.empty()) text += ", " + nearest;
  return text + ", \"" + spoken + "\"";
}

record::Fields LoopFigures::row(const ClosedLoop& loop) const {
  std::string hits;
  for (const auto& [thing_class, count] : hits_)
    hits += (hits.empty() ? "" : " ") + thing_class + " " + std::to_string(count);
  const auto state = [&](const char* name) {
    const auto found = states_.find(name);
    return found == states_.end() ? 0.0 : found->second;
  };
  double known = 0.0;
  record::Fields row;
  row.set("result", result_).set("time", time_, 1);
  row.set("driven", monitor_.tally().path_length, 1).set("shortest", shortest_, 1);
  row.set("hits", hits.empty() ? "-" : hits).set("reroutes", std::uint64_t{reroutes_});
  directions_.add_to(row, time_);
  row.set("late", std::uint64_t{warnings_.late()});
  row.set("speechless", std::uint64_t{stands_.speechless()}).set("warned", warnings_.warned());
  for (const char* name : {"following", "blocked", "make_room", "no_route", "off_mesh"}) {
    row.set(name, state(name), 1);
    known += state(name);
  }
  row.set("other", std::max(0.0, time_ - known), 1);
  speech_.add_to(row, time_);
  turns_made_.add_to(row);
  row.set("least_gap", std::max(0.0, least_gap_), 2);
  row.set("motors", felt_for_ / std::max(time_, 1.0), 3);
  sensing_.add_to(row);
  stands_.add_to(row);
  return row.set("hash", navvi_types::to_hex(loop.session().world().state_hash()));
}

}  // namespace navvi_study::batch
