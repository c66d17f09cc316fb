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

constexpr double kPi = 3.14159265358979323846;
constexpr double kStay = 0.3;        // m; who does not leave this circle stands still
constexpr double kNearby = 1.5;      // m; what is farther away does not hold a robot up
constexpr double kJustBefore = 8.0;  // s; of two directions, the later one is not news of its own
constexpr double kSamePlace = 1.5;   // m, likewise
constexpr double kAnswered = 1.0;    // s, within which a question is answered
constexpr double kContrary = 75.0 * kPi / 180.0;
constexpr double kReversed = 105.0 * kPi / 180.0;  // 4 hours, as hours are rounded
constexpr double kSoon = 4.0;                      // s, within which that confuses
constexpr double kFelt = 3.0;                      // s before a contact; likewise
constexpr double kTold = 2.0;                      // s
constexpr double kLongAgo = 10.0;                  // s; a word before that was no warning
constexpr double kInVain = 3.0;                    // s
constexpr double kPushed = 0.2;                    // of the stick
constexpr double kStill = 0.05;                    // m/s and rad/s

std::string metres(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f m", value);
  return text.data();
}

bool tells_new_way(CueKind kind) {
  switch (kind) {
    case CueKind::rerouted:
    case CueKind::rerouted_blocked:
    case CueKind::new_route:
    case CueKind::no_route:
    case CueKind::make_room:
      return true;
    default:
      return false;
  }
}

bool asks_to_turn(const navvi_types::CueEvent& cue) {
  if (cue.kind()) return traits(*cue.kind()).ask == navvi_types::Ask::turn;
  return cue.word() == to_string(navvi_types::Earcon::turn);
}

/// How many hours lie between two, the shorter way round.
int hours_between(int a, int b) {
  const int apart = std::abs(a - b) % 12;
  return std::min(apart, 12 - apart);
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
    if (begun_) judge_warning(contact, loop.time());
  }
  if (told.proximity) {
    if (const auto report = navvi_types::from_msg(*told.proximity)) (void)monitor_.observe(*report);
    feel(*told.proximity, loop.time());
  }
  if (loop.hand().repeat) asked_ = loop.time();
  for (const auto& cue : told.cues) {
    const auto report = navvi_types::from_msg(cue);
    if (report) (void)monitor_.observe(*report);
    if (report && begun_) speech_.hear(*report, loop.time() - asked_ < kAnswered, loop.time());
    if (!report || report->stage != navvi_types::CueStage::started) continue;
    if (begun_) listen(loop, *report);
    if (asks_to_turn(*report)) turns_made_.ask(loop.time());
    hear(*report, loop.time());
  }
  if (told.guidance) {
    if (const auto report = navvi_types::from_msg(*told.guidance)) {
      (void)monitor_.observe(*report);
      state_ = report->state;
      course_.reset();
      if (report->is_followed()) course_ = robot.yaw - report->steer_angle;
    }
    if (begun_) take(*told.guidance);
  }
  if (!begun_) return true;
  sensing_.watch(loop);
  time_ = loop.time() - *begun_;
  states_[to_string(state_)] += loop.dt();
  if (told.motors.left > 0.0 || told.motors.right > 0.0) felt_for_ += loop.dt();
  judge_turns(loop);
  stand(loop);
  push(loop);
  if (monitor_.reached()) result_ = "reached";
  if (loop.person().gave_up()) result_ = "gave_up";
  if (monitor_.refused()) result_ = "refused: " + *monitor_.refused();
  return result_ == "timeout" && time_ < limit_;
}

void LoopFigures::feel(const navvi_msgs::Proximity& near, double time) {
  std::map<std::uint32_t, double> felt;
  for (const auto& thing : near.things)
    felt[thing.id] = felt_.count(thing.id) > 0 ? felt_[thing.id] : time;
  felt_ = felt;
  nearest_.clear();
  if (near.things.empty()) return;
  const auto& nearest = near.things.front();
  if (begun_) least_gap_ = std::min(least_gap_, nearest.gap);
  if (nearest.gap < kNearby) nearest_ = nearest.thing_class + " at " + metres(nearest.gap);
}

void LoopFigures::begin(const ClosedLoop& loop) {
  begun_ = loop.time();
  const Eigen::Vector2d& goal = loop.scenario().goal;
  const auto stamp = static_cast<std::int64_t>(std::llround(loop.time() * 1e9));
  monitor_.start(monitor_.start_now(stamp, goal));
  stay_ = loop.session().world().now().robot.position;
}

void LoopFigures::take(const navvi_msgs::Guidance& guidance) {
  blocked_by_ = guidance.blocked_by;
  reroutes_ = std::max(reroutes_, guidance.reroutes);
  if (shortest_ == 0.0) shortest_ = guidance.shortest_length;
}

void LoopFigures::listen(const ClosedLoop& loop, const navvi_types::CueEvent& cue) {
  if (!cue.kind()) return;
  const CueKind kind = *cue.kind();
  spoken_ = cue.text;
  const auto parts = loop.person().listener().understand(kind, cue.text);
  if (parts.empty()) return;
  const people::Instruction& instruction = parts.back();
  const double driven = monitor_.tally().path_length;
  const bool new_way = tells_new_way(kind);
  const bool replaced =
      new_way || kind == CueKind::straight_then || kind == CueKind::turn_cancelled;
  if (replaced || driven > announced_until_) announced_.reset();
  if (kind == CueKind::turn_ahead) {
    announced_ = instruction.hour;
    announced_until_ = driven + instruction.distance.value_or(0.0) + kSamePlace;
    return;
  }
  const bool turn = instruction.asks == people::Ask::turn;
  if (!turn && instruction.asks != people::Ask::go) return;
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  const Said now{instruction.hour, robot.yaw - instruction.hour * kPi / 6.0, loop.time(),
                 robot.position};
  if (kind == CueKind::turn_now && announced_) {
    if (hours_between(*announced_, now.hour) > 1) ++misled_;
    announced_.reset();
  }
  if (said_) {
    if (said_->hour != now.hour) ++turns_;
    // Whoever has come to a corner is rightly sent elsewhere.
    if (kind != CueKind::turn_now && now.time - said_->time < kJustBefore &&
        (now.place - said_->place).norm() < kSamePlace &&
        std::abs(std::remainder(now.course - said_->course, 2.0 * kPi)) > kContrary)
      ++flips_;
    const bool reason = kind == CueKind::turn_now || new_way;
    if (!reason && now.time - said_->time < kSoon &&
        std::abs(std::remainder(now.course - said_->course, 2.0 * kPi)) > kReversed)
      ++reversed_;
  }
  said_ = now;
}

void LoopFigures::hear(const navvi_types::CueEvent& cue, double time) {
  pushed_.reset();
  for (const char* mover : {"worker", "forklift", "pallet_robot"}) {
    std::string word = mover;
    const bool sound = cue.word().find(word) != std::string::npos;
    std::replace(word.begin(), word.end(), '_', ' ');
    if (sound || cue.text.find(word) != std::string::npos) named_[mover].push_back(time);
  }
}

void LoopFigures::judge_warning(const navvi_msgs::Contact& contact, double time) {
  const auto named = named_.find(contact.thing_class);
  const bool moves = contact.thing_class == "worker" || contact.thing_class == "forklift" ||
                     contact.thing_class == "pallet_robot";
  if (!moves) return;
  double told = 0.0;
  if (named != named_.end())
    for (const double said : named->second)
      if (time - said < kLongAgo) told = std::max(told, time - said);
  const double felt = felt_.count(contact.id) > 0 ? time - felt_[contact.id] : 0.0;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%s%.1f/%.1f", warned_.empty() ? "" : " ", felt, told);
  warned_ += text.data();
  if (felt < kFelt || told < kTold) ++late_;
}

/// A person who pushes in vain, and hears nothing, does not know why.
void LoopFigures::push(const ClosedLoop& loop) {
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  const bool pushes = std::max(std::abs(loop.hand().forward), std::abs(loop.hand().left)) > kPushed;
  const bool still = std::abs(robot.forward_speed()) < kStill && std::abs(robot.turn_rate) < kStill;
  if (!pushes || !still) pushed_.reset();
  if (!pushed_ && pushes && still) pushed_ = loop.time();
  if (!pushed_ || loop.time() - *pushed_ < kInVain) return;
  ++speechless_;
  pushed_ = loop.time();
}

void LoopFigures::judge_turns(const ClosedLoop& loop) {
  const navvi_sim::physics::RobotState& robot = loop.session().world().now().robot;
  std::optional<double> off;
  if (course_) off = navvi_types::wrap(robot.yaw - *course_);
  turns_made_.watch(robot.turn_rate, robot.forward_speed(), off, loop.time());
}

void LoopFigures::stand(const ClosedLoop& loop) {
  const Eigen::Vector2d& at = loop.session().world().now().robot.position;
  if (time_ - stay_since_ > still_) {
    still_ = time_ - stay_since_;
    still_at_ = stay_since_;
    why_ = about();
  }
  if ((at - stay_).norm() <= kStay) return;
  stay_ = at;
  stay_since_ = time_;
}

std::string LoopFigures::about() const {
  std::string text = to_string(state_);
  if (!blocked_by_.empty()) text += " by " + blocked_by_;
  if (!nearest_.empty()) text += ", " + nearest_;
  return text + ", \"" + spoken_ + "\"";
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
  row.set("turns", time_ > 0.0 ? 60.0 * turns_ / time_ : 0.0, 1);
  row.set("flips", std::uint64_t{flips_}).set("misled", std::uint64_t{misled_});
  row.set("reversed", std::uint64_t{reversed_}).set("late", std::uint64_t{late_});
  row.set("speechless", std::uint64_t{speechless_}).set("warned", warned_.empty() ? "-" : warned_);
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
  row.set("still", still_, 1).set("still_at", still_at_, 1).set("why", why_);
  return row.set("hash", navvi_types::to_hex(loop.session().world().state_hash()));
}

}  // namespace navvi_study::batch
