#include "trial/trial_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>
#include <utility>

#include "record/figures.hpp"

namespace navvi_study::trial {
namespace {

using record::kSameGoal;
constexpr std::size_t kReports = 20;  // of latencies; some seconds
constexpr double kMoved = 0.05;       // m, driven
constexpr double kTurned = 0.1;       // rad
constexpr double kOldNews = 2.0;      // s in which guidance may be of the same place, set before
constexpr double kBeside = 3.0;       // m, from the hull to a thing beside the robot
constexpr double kAhead = 1.0;        // s, farther no report is, but for a clock that was set back

std::int64_t ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

bool same(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return (a - b).norm() < kSameGoal; }

/// With shelves, or with everything else.
std::uint64_t count_in(const Contact& contact, bool shelves) {
  std::uint64_t sum = 0;
  for (const auto& [thing_class, count] : contact.counts)
    if ((thing_class == ThingClass::shelf) == shelves) sum += count;
  return sum;
}

/// The class of the nearest thing on one side, or nothing. \param side  1: left, -1: right
std::string beside(const Proximity& proximity, double side) {
  for (const NearThing& thing : proximity.things) {
    const double lateral = side * thing.nearest.y();
    if (thing.gap <= kBeside && lateral > std::abs(thing.nearest.x()))
      return to_string(thing.thing_class);
  }
  return "nothing";
}

}  // namespace

bool TrialMonitor::counts(std::int64_t stamp) {
  latest_ = std::max(latest_, stamp);
  return start_ && stamp > start_->stamp && (!end_ || stamp <= *end_);
}

bool TrialMonitor::ahead(std::int64_t stamp, std::int64_t clock) const {
  const double s = 1e-9 * static_cast<double>(stamp - std::max(clock, latest_));
  return clock != 0 && s > kAhead + round_trip_;
}

TrialStart TrialMonitor::start_now(std::int64_t stamp, const Eigen::Vector2d& goal) {
  if (1e-9 * static_cast<double>(latest_ - stamp) > kAhead + round_trip_) latest_ = stamp;
  return {std::max(stamp, latest_), goal, hits_, false, round_trip_};
}

void TrialMonitor::start(const TrialStart& start) {
  start_ = start;
  end_.reset();
  tally_ = Tally();
  hits_ = start.hits;
  inside_.clear();
  for (auto& felt : felt_) felt.second = start.stamp;
  driven_ = {std::nullopt, 0.0, driven_.seen, start.stamp, std::nullopt};
  guided_ = {std::nullopt, guided_.guidance, std::nullopt, 0, std::nullopt};
  playing_.clear();
  latencies_.clear();
  links_.clear();
  stuck_cues_.clear();
  assists_ = {};
  goal_ = {};
  world_restarted_ = false;
  clock_jumped_ = false;
}

Event TrialMonitor::change_goal(const Eigen::Vector2d& goal, std::int64_t stamp) {
  start_->goal = goal;
  guided_.before = guided_.guidance ? guided_.guidance : guided_.before;
  goal_ = {};
  return {"GOAL_SET", place().set("goal_x", goal.x()).set("goal_y", goal.y()), stamp, true};
}

void TrialMonitor::end(std::int64_t stamp) { end_ = end_ ? std::min(*end_, stamp) : stamp; }

record::Fields TrialMonitor::place() const {
  record::Fields fields;
  const auto& last = driven_.odometry ? driven_.odometry : driven_.seen;
  if (!last) return fields.set("x", "n/a").set("y", "n/a");
  const Eigen::Vector2d& at = last->pose.position;
  return fields.set("x", at.x()).set("y", at.y());
}

const char* TrialMonitor::zone(double lateral) const {
  if (lateral > config_.center_range) return "left";
  return lateral < -config_.center_range ? "right" : "center";
}

record::Fields TrialMonitor::tally_fields() const {
  record::Fields fields = place();
  fields.set("path_length", tally_.path_length).set("cues_spoken", tally_.cues_spoken);
  fields.set("sounds_played", tally_.sounds_played).set("patterns_felt", tally_.patterns_felt);
  fields.set("reroutes", tally_.reroutes);
  fields.set("missed_messages", tally_.missed_messages);
  fields.set("state_step", world_state_ ? std::to_string(world_state_->step) : "n/a");
  return fields.set("state_hash", world_state_ ? navvi_types::to_hex(world_state_->hash) : "n/a");
}

record::Fields TrialMonitor::end_fields() const {
  record::Fields fields = tally_fields();
  const auto& last = driven_.odometry ? driven_.odometry : driven_.seen;
  if (last) fields.set("yaw", last->pose.yaw);
  if (driven_.near)
    fields.set("left", beside(*driven_.near, 1.0)).set("right", beside(*driven_.near, -1.0));
  std::vector<double> trips;
  double longest = 0.0, loss = 0.0;
  for (const LinkState& link : links_) {
    if ((end_ && link.stamp > *end_) || link.round_trip == 0.0) continue;
    trips.push_back(link.round_trip);
    longest = std::max(longest, link.round_trip_99);
    loss += link.loss;
  }
  if (!trips.empty()) {
    std::sort(trips.begin(), trips.end());
    fields.set("round_trip", trips[trips.size() / 2])
        .set("round_trip_99", longest)
        .set("link_loss", loss / static_cast<double>(trips.size()));
  }
  for (auto report = latencies_.rbegin(); report != latencies_.rend(); ++report) {
    if (end_ && report->stamp > *end_) continue;
    for (const std::string& name : record::reported_columns())
      if (const auto known = report->traits.find(name); known != report->traits.end())
        fields.set(name, known->second);
    break;
  }
  return fields;
}

std::vector<Event> TrialMonitor::observe(const Odometry& odometry) {
  driven_.seen = odometry;
  if (!counts(odometry.stamp)) return {};
  if (driven_.odometry && odometry.stamp <= driven_.odometry->stamp) return {};
  if (driven_.odometry) {
    const Eigen::Vector2d moved = odometry.pose.position - driven_.odometry->pose.position;
    tally_.path_length += moved.norm();
    const double turned = navvi_types::wrap(odometry.pose.yaw - driven_.first_yaw);
    tally_.turned = std::max(tally_.turned, std::abs(turned));
  } else {
    driven_.first_yaw = odometry.pose.yaw;
  }
  driven_.odometry = odometry;
  if (odometry.stamp < driven_.next_progress) return {};
  driven_.next_progress = odometry.stamp + ns(config_.kProgressPeriod);
  return {{"PROGRESS", tally_fields(), odometry.stamp, false}};
}

void TrialMonitor::collision(const Contact* contact, bool shelf, std::int64_t stamp,
                             std::vector<Event>& events) {
  auto& count = shelf ? tally_.shelf_collisions : tally_.obstacle_collisions;
  ++count;
  record::Fields fields;
  fields.set("kind", shelf ? "shelf" : "obstacle").set("count", count);
  if (contact != nullptr) {
    fields.set("x", contact->robot.position.x()).set("y", contact->robot.position.y());
    fields.set("class", to_string(contact->thing_class)).set("thing", contact->name);
    fields.set("speed", contact->speed);
    const auto felt = felt_.find(contact->id);
    const std::int64_t since = felt != felt_.end() ? felt->second : stamp;
    fields.set("felt", 1e-9 * static_cast<double>(stamp - since));
  } else {
    fields.set("made_good", "yes");
  }
  events.push_back({"COLLISION", fields, stamp, true});
}

std::vector<Event> TrialMonitor::observe(const Contact& contact) {
  const bool inside = counts(contact.stamp);
  const bool shelf = contact.thing_class == ThingClass::shelf;
  const std::uint64_t shelves = count_in(contact, true), obstacles = count_in(contact, false);
  std::vector<Event> events;
  const bool first = inside && tally_.shelf_collisions + tally_.obstacle_collisions == 0;
  // By a count that began anew since the last trial, or of a world that others drove in before.
  if (first && contact.seq > 0 &&
      (contact.seq <= hits_.contact_seq || (hits_.contact_seq == 0 && !start_->hits_known)))
    hits_ = {contact.seq - 1, shelves - (shelf ? 1 : 0), obstacles - (shelf ? 0 : 1)};
  if (inside && contact.seq <= hits_.contact_seq) {
    if (contact.seq == 1) world_restarted_ = true;
    return {};
  }
  if (inside) {
    // Running counts that jump by more than this contact show the contacts that were lost.
    const std::uint64_t missed_shelf =
        shelves - std::min(shelves, hits_.shelf_count + (shelf ? 1 : 0));
    const std::uint64_t missed_obstacle =
        obstacles - std::min(obstacles, hits_.obstacle_count + (shelf ? 0 : 1));
    const std::uint64_t missed = contact.seq - hits_.contact_seq - 1;
    tally_.missed_messages += missed;
    for (std::uint64_t i = 0; i < std::min(missed_shelf, missed); ++i)
      collision(nullptr, true, contact.stamp, events);
    for (std::uint64_t i = 0; i < std::min(missed_obstacle, missed); ++i)
      collision(nullptr, false, contact.stamp, events);
    collision(&contact, shelf, contact.stamp, events);
  }
  hits_ = {contact.seq, shelves, obstacles};
  return events;
}

std::vector<Event> TrialMonitor::observe(const Proximity& proximity) {
  std::map<std::uint32_t, std::int64_t> felt;
  const std::int64_t since = std::max(proximity.stamp, start_ ? start_->stamp : 0);
  for (const auto& thing : proximity.things)
    felt[thing.id] = felt_.try_emplace(thing.id, since).first->second;
  felt_ = std::move(felt);
  if (!counts(proximity.stamp)) return {};
  driven_.near = proximity;
  std::vector<Event> events;
  const auto event = [&](const char* type, const NearThing& thing) {
    record::Fields fields;
    fields.set("kind", thing.thing_class == ThingClass::shelf ? "shelf" : "obstacle");
    fields.set("id", std::uint64_t{thing.id}).set("class", to_string(thing.thing_class));
    fields.set("thing", thing.name).set("gap", thing.gap).set("zone", zone(thing.nearest.y()));
    const auto at = driven_.odometry ? driven_.odometry->pose.position : Eigen::Vector2d(NAN, NAN);
    fields.set("x", at.x()).set("y", at.y());
    events.push_back({type, fields, proximity.stamp, true});
  };
  for (const auto& thing : proximity.things) {
    const double range =
        thing.thing_class == ThingClass::shelf ? config_.shelf_range : config_.obstacle_range;
    const auto known = inside_.find(thing.id);
    if (known == inside_.end()) {
      if (thing.gap > range) continue;
      inside_[thing.id] = {proximity.stamp, thing};
      event("PROXIMITY_ENTER", thing);
    } else {
      known->second.thing = thing;
      if (thing.gap <= range + config_.leave_margin) known->second.last_inside = proximity.stamp;
    }
  }
  for (auto it = inside_.begin(); it != inside_.end();) {
    if (proximity.stamp - it->second.last_inside > ns(config_.leave_time)) {
      event("PROXIMITY_LEAVE", it->second.thing);
      it = inside_.erase(it);
    } else {
      ++it;
    }
  }
  return events;
}

bool TrialMonitor::about_this_goal(const Guidance& guidance) {
  using State = Guidance::State;
  if (goal_.taken) return true;
  const auto& before = guided_.before;
  const bool goal_matches = same(guidance.goal, start_->goal);
  // Each time that a goal is set, the guide plans anew, also to where it leads already.
  const bool old =
      goal_matches && before && same(before->goal, start_->goal) &&
      guidance.stamp <= start_->stamp + ns(kOldNews + start_->round_trip) &&
      (guidance.plans == before->plans || guidance.replan_reason != Guidance::Replan::new_goal);
  if (guidance.state == State::goal_refused) {
    // A refusal may come with the goal that is still valid. The last goal's may be of this place:
    // the person asks for it a second time.
    const bool was_refused = before && before->state == State::goal_refused;
    goal_.taken = !was_refused || (goal_matches && !old);
  } else {
    goal_.taken = goal_matches && !old &&
                  (guidance.leads_to_goal() || guidance.state == State::arrived ||
                   guidance.state == State::no_route || guidance.state == State::off_mesh);
  }
  return goal_.taken;
}

std::vector<Event> TrialMonitor::observe(const Guidance& guidance) {
  using State = Guidance::State;
  const bool inside = counts(guidance.stamp);
  const auto last = guided_.guidance;
  guided_.guidance = guidance;
  if (!inside) return {};
  if (last && guidance.seq > last->seq) tally_.missed_messages += guidance.seq - last->seq - 1;
  if (!about_this_goal(guidance)) return {};

  std::vector<Event> events;
  if (guided_.state != guidance.state) {
    guided_.state = guidance.state;
    events.push_back({"GUIDANCE", place().set("state", to_string(guidance.state)), guidance.stamp});
  }
  // Only a guidance that was started anew forgets a goal that it had taken.
  if (guidance.state == State::no_goal) goal_.taken = false;
  if (guidance.leads_to_goal()) {
    const bool first = !guided_.plans;
    if (first) guided_.plans = guidance.plans;
    // A path that ends short of the goal has no length to compare a drive with.
    if (first && !guidance.ends_short) {
      record::Fields fields = place();
      fields.set("first_path_length", guidance.goal_distance);
      fields.set("shortest_path", guidance.shortest_length);
      events.push_back({"ROUTE", fields.set("plan_time", guidance.plan_time, 6), guidance.stamp});
    }
  }
  count_plans(guidance, events);
  if (guidance.state == State::arrived && !goal_.arrival && !goal_.arrived_elsewhere)
    arrive(guidance, events);
  if (guidance.state == State::goal_refused && !goal_.refused) {
    goal_.refused = to_string(guidance.refusal);
    events.push_back({"GOAL_REFUSED", place().set("reason", *goal_.refused), guidance.stamp});
  }
  return events;
}

/// The guide's word alone is not enough: it may follow a false pose.
void TrialMonitor::arrive(const Guidance& guidance, std::vector<Event>& events) {
  record::Fields fields = place();
  const auto& robot = driven_.odometry ? driven_.odometry : driven_.seen;
  if (robot && navvi_types::arrived_elsewhere(robot->pose.position, start_->goal,
                                              config_.arrival_range)) {
    goal_.arrived_elsewhere = true;
    const double away = (robot->pose.position - start_->goal).norm();
    events.push_back({"ARRIVED_ELSEWHERE", fields.set("distance", away), guidance.stamp});
    return;
  }
  goal_.arrival = moved() ? Ending{"reached", "goal_reached", guidance.stamp}
                          : Ending{"refused", "goal_at_start", guidance.stamp};
  fields.set("elapsed", static_cast<double>(guidance.stamp - start_->stamp) * 1e-9);
  events.push_back({"GOAL_REACHED", fields, guidance.stamp});
}

bool TrialMonitor::moved() const {
  return tally_.path_length > kMoved || tally_.turned > kTurned;
}

void TrialMonitor::count_plans(const Guidance& guidance, std::vector<Event>& events) {
  // A guidance that was started anew counts from 0, reroutes also with each goal.
  if (guided_.plans && guidance.plans < *guided_.plans) guided_.plans = 0;
  if (guided_.plans && guidance.plans > *guided_.plans) {
    tally_.replans += guidance.plans - *guided_.plans;
    guided_.plans = guidance.plans;
    record::Fields fields = place();
    fields.set("count", tally_.replans).set("reason", to_string(guidance.replan_reason));
    events.push_back(
        {"REPLAN", fields.set("plan_time", guidance.plan_time, 6), guidance.stamp, false});
  }
  if (guidance.reroutes < guided_.reroutes) guided_.reroutes = 0;
  if (guidance.reroutes > guided_.reroutes) {
    tally_.reroutes += guidance.reroutes - guided_.reroutes;
    record::Fields fields = place();
    fields.set("count", tally_.reroutes).set("reason", to_string(guidance.reroute_reason));
    events.push_back({"REROUTE", fields, guidance.stamp});
  }
  guided_.reroutes = guidance.reroutes;
}

std::optional<Event> TrialMonitor::row_of(const CueEvent& cue) {
  const bool begins = cue.stage == CueStage::started;
  if (!begins && cue.stage != CueStage::ended && cue.stage != CueStage::cut) return std::nullopt;
  if (cue.modality() != Modality::speech) {
    // What is played or felt is reported at each change of strength; a row is for a new kind.
    const std::string before = std::exchange(playing_[cue.modality()], begins ? cue.word() : "");
    if (begins && cue.modality() == Modality::sound && !cue.lasts()) ++tally_.sounds_played;
    if (!begins || cue.word() == before || cue.lasts()) return std::nullopt;
    if (cue.modality() == Modality::rumble) ++tally_.patterns_felt;
  }
  record::Fields fields = place();
  fields.set("id", std::uint64_t{cue.id}).set("modality", to_string(cue.modality()));
  fields.set("kind", cue.word())
      .set("text", cue.text.empty() ? "n/a" : cue.text)
      .set("stage", to_string(cue.stage));
  if (begins) understand(cue, fields);
  return Event{begins ? "CUE" : "CUE_END", fields, cue.stamp, false};
}

/// What the sentence asks for in its last part, and of a direction its hour and how far away.
void TrialMonitor::understand(const CueEvent& cue, record::Fields& fields) const {
  if (listener_ == nullptr || !cue.kind()) return;
  const auto parts = listener_->understand(*cue.kind(), cue.text);
  if (parts.empty()) return;
  const auto asks = parts.back().asks;
  fields.set("asks", asks == navvi_types::Ask::turn ? "turn"
                     : asks == navvi_types::Ask::go ? "go"
                                                    : "other");
  fields.set("hour", static_cast<std::uint64_t>(parts.back().hour));
  if (parts.back().distance) fields.set("within", *parts.back().distance);
}

std::vector<Event> TrialMonitor::observe(const CueEvent& cue) {
  if (!counts(cue.stamp)) return {};
  std::vector<Event> events;
  if (const auto row = row_of(cue)) events.push_back(*row);
  if (cue.modality() != Modality::speech) return events;
  if (cue.stage == CueStage::started) ++tally_.cues_spoken;
  // A feedback_node that was started anew numbers its cues from 1.
  if (cue.stage == CueStage::queued && stuck_cues_.lower_bound(cue.id) != stuck_cues_.end())
    stuck_cues_.clear();
  // However its speech fares, a cue that says stuck is the fact of being stuck.
  const std::vector<CueKind>& stuck = start_->stuck;
  const bool says_stuck = std::find(stuck.begin(), stuck.end(), cue.kind()) != stuck.end();
  if (says_stuck && stuck_cues_.insert(cue.id).second)
    events.push_back({"STUCK", place(), cue.stamp, true});
  return events;
}

std::vector<Event> TrialMonitor::observe(const DriveState& drive) {
  const bool inside = counts(drive.stamp);
  const DriveState::Reason reason =
      drive.state == DriveState::State::stopped ? drive.reason : DriveState::Reason::none;
  const DriveState::Reason before = std::exchange(stopped_for_, reason);
  const std::string intruder_before = std::exchange(intruder_, drive.intruder);
  if (reason == DriveState::Reason::clock_jumped && reason != before) clock_jumped_ = true;
  std::vector<Event> events;
  if (!inside) return events;
  if (const auto before_it = std::exchange(assists_, drive.assistance); before_it != assists_)
    events.push_back({"ASSISTED", place().set("does", to_string(assists_)), drive.stamp});
  if (drive.intruder != intruder_before)
    events.push_back({"INTRUDER", place().set("node", drive.intruder), drive.stamp});
  if (reason == DriveState::Reason::none || reason == before) return events;
  record::Fields fields = place();
  fields.set("reason", to_string(reason));
  if (before != DriveState::Reason::none) fields.set("held", "yes");
  fields.set("moved", moved() ? "yes" : "no");
  events.push_back({"SAFE_STOP", fields, drive.stamp, true});
  return events;
}

std::vector<Event> TrialMonitor::observe(const LinkState& link) {
  round_trip_ = link.round_trip;
  const bool begins = link.late != LinkState::Late::no &&
                      (links_.empty() || links_.back().late == LinkState::Late::no);
  if (!counts(link.stamp)) return {};
  links_.push_back(link);
  if (!begins) return {};
  return {{"LINK_LATE", place().set("late", to_string(link.late)), link.stamp}};
}

std::vector<Event> TrialMonitor::observe(const DeviceReport& device) {
  const bool inside = counts(device.stamp);
  if (inside && device.device == "latency") {
    latencies_.push_back(device);
    if (latencies_.size() > kReports) latencies_.erase(latencies_.begin());
  }
  const auto known = devices_.find(device.device);
  const auto losses = [](const DeviceReport& report) {
    const auto count = report.traits.find("losses");
    return count == report.traits.end() ? std::string("0") : count->second;
  };
  if (known == devices_.end() || !inside) {
    devices_[device.device] = device;
    return {};
  }
  const DeviceReport before = std::exchange(known->second, device);
  const auto event = [&](const char* type) {
    return Event{type, place().set("device", device.device), device.stamp, true};
  };
  if (before.state != device.state)
    return {event(device.state == DeviceState::works ? "DEVICE_BACK" : "DEVICE_LOST")};
  // It was back before it was reported lost.
  if (losses(before) != losses(device) && losses(device) != "0")
    return {event("DEVICE_LOST"), event("DEVICE_BACK")};
  return {};
}

std::vector<Event> TrialMonitor::observe(const StateHash& state) {
  latest_ = std::max(latest_, state.stamp);
  if (!end_ || state.stamp <= *end_) world_state_ = state;
  return {};
}

}  // namespace navvi_study::trial
