#include "navvi_study/trial_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_study {
namespace {

constexpr double kSameGoal = 0.05;  // m
constexpr double kMoved = 0.05;     // m, driven
constexpr std::int64_t kOldNews =
    2'000'000'000;  // ns in which an arrival may still be the last goal's

std::int64_t ns(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

bool same(const Point2& a, const Point2& b) { return std::hypot(a.x - b.x, a.y - b.y) < kSameGoal; }

}  // namespace

const char* to_string(GuidanceReport::State state) {
  switch (state) {
    case GuidanceReport::State::no_goal:
      return "no_goal";
    case GuidanceReport::State::following:
      return "following";
    case GuidanceReport::State::arrived:
      return "arrived";
    case GuidanceReport::State::refused:
      return "goal_refused";
    case GuidanceReport::State::no_route:
      return "no_route";
    case GuidanceReport::State::off_mesh:
      return "off_mesh";
    case GuidanceReport::State::no_map:
      return "no_map";
    case GuidanceReport::State::pose_stale:
      return "pose_stale";
    case GuidanceReport::State::map_stale:
      return "map_stale";
    case GuidanceReport::State::blocked:
      return "blocked";
    case GuidanceReport::State::make_room:
      return "make_room";
  }
  return "unknown";
}

void TrialMonitorConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"obstacle_range", Range{0.1, 50.0}, "m", "an obstacle this near is a proximity event"},
        obstacle_range);
  visit({"shelf_range", Range{0.1, 50.0}, "m", "a shelf this near is a proximity event"},
        shelf_range);
  visit({"leave_margin", Range{0.0, 5.0}, "m", "a near thing has left beyond its range plus this"},
        leave_margin);
  visit({"leave_time", Range{0.0, 10.0}, "s", "and has been there this long"}, leave_time);
  visit({"center_range", Range{0.0, 10.0}, "m", "up to this far aside, a thing is in the centre"},
        center_range);
  visit({"progress_period", Range{0.1, 60.0}, "s", "between rows that only say how far one got"},
        progress_period);
}

bool TrialMonitor::counts(std::int64_t stamp) {
  latest_ = std::max(latest_, stamp);
  return start_ && stamp > start_->stamp && (!end_ || stamp <= *end_);
}

TrialStart TrialMonitor::start_now(std::int64_t stamp, const Point2& goal) const {
  return {std::max(stamp, latest_), goal, contact_seq_, shelf_count_, obstacle_count_};
}

void TrialMonitor::start(const TrialStart& start) {
  start_ = start;
  end_.reset();
  tally_ = Tally();
  next_progress_ = start.stamp;
  contact_seq_ = start.contact_seq;
  shelf_count_ = start.shelf_count;
  obstacle_count_ = start.obstacle_count;
  inside_.clear();
  odometry_.reset();
  guidance_before_ = guidance_;
  guidance_.reset();
  plans_.reset();
  stuck_cues_.clear();
  goal_taken_ = false;
  state_.reset();
  reached_.reset();
  refused_.reset();
  world_restarted_ = false;
}

Event TrialMonitor::change_goal(const Point2& goal, std::int64_t stamp) {
  start_->goal = goal;
  guidance_before_ = guidance_ ? guidance_ : guidance_before_;
  goal_taken_ = false;
  reached_.reset();
  refused_.reset();
  return {"GOAL_SET", Fields().set("goal_x", goal.x).set("goal_y", goal.y), stamp, true};
}

void TrialMonitor::end(std::int64_t stamp) { end_ = end_ ? std::min(*end_, stamp) : stamp; }

Fields TrialMonitor::place() const {
  Fields fields;
  if (!odometry_) return fields.set("x", "n/a").set("y", "n/a");
  return fields.set("x", odometry_->position.x).set("y", odometry_->position.y);
}

const char* TrialMonitor::zone(double lateral) const {
  if (lateral > config_.center_range) return "left";
  return lateral < -config_.center_range ? "right" : "center";
}

Fields TrialMonitor::tally_fields() const {
  Fields fields = place();
  fields.set("path_length", tally_.path_length).set("cues_spoken", tally_.cues_spoken);
  fields.set("missed_messages", tally_.missed_messages);
  fields.set("state_step", world_state_ ? std::to_string(world_state_->step) : "n/a");
  return fields.set("state_hash", world_state_ ? world_state_->hash : "n/a");
}

std::vector<Event> TrialMonitor::observe(const OdometryReport& odometry) {
  if (!counts(odometry.stamp)) return {};
  if (odometry_ && odometry.stamp <= odometry_->stamp) return {};
  if (odometry_) {
    tally_.path_length += std::hypot(odometry.position.x - odometry_->position.x,
                                     odometry.position.y - odometry_->position.y);
  }
  odometry_ = odometry;
  if (odometry.stamp < next_progress_) return {};
  next_progress_ = odometry.stamp + ns(config_.progress_period);
  return {{"PROGRESS", tally_fields(), odometry.stamp, false}};
}

void TrialMonitor::collision(const ContactReport* contact, bool shelf, std::int64_t stamp,
                             std::vector<Event>& events) {
  auto& count = shelf ? tally_.shelf_collisions : tally_.obstacle_collisions;
  ++count;
  Fields fields;
  fields.set("kind", shelf ? "shelf" : "obstacle").set("count", count);
  if (contact != nullptr) {
    fields.set("x", contact->robot.x).set("y", contact->robot.y);
    fields.set("class", contact->thing_class).set("thing", contact->thing);
    fields.set("speed", contact->speed);
  } else {
    fields.set("made_good", "yes");
  }
  events.push_back({"COLLISION", fields, stamp, true});
}

std::vector<Event> TrialMonitor::observe(const ContactReport& contact) {
  const bool inside = counts(contact.stamp);
  const bool shelf = contact.thing_class == "shelf";
  std::vector<Event> events;
  if (inside && contact.seq <= contact_seq_) {
    if (contact.seq == 1) world_restarted_ = true;
    return {};
  }
  if (inside) {
    // Running counts that jump by more than this contact tell what was lost on the way.
    const std::uint64_t missed_shelf =
        contact.shelf_count - std::min(contact.shelf_count, shelf_count_ + (shelf ? 1 : 0));
    const std::uint64_t missed_obstacle =
        contact.obstacle_count -
        std::min(contact.obstacle_count, obstacle_count_ + (shelf ? 0 : 1));
    const std::uint64_t missed = contact.seq - contact_seq_ - 1;
    tally_.missed_messages += missed;
    for (std::uint64_t i = 0; i < std::min(missed_shelf, missed); ++i) {
      collision(nullptr, true, contact.stamp, events);
    }
    for (std::uint64_t i = 0; i < std::min(missed_obstacle, missed); ++i) {
      collision(nullptr, false, contact.stamp, events);
    }
    collision(&contact, shelf, contact.stamp, events);
  }
  contact_seq_ = contact.seq;
  shelf_count_ = contact.shelf_count;
  obstacle_count_ = contact.obstacle_count;
  return events;
}

std::vector<Event> TrialMonitor::observe(const ProximityReport& proximity) {
  if (!counts(proximity.stamp)) return {};
  std::vector<Event> events;
  const auto event = [&](const char* type, const NearThing& thing) {
    Fields fields;
    fields.set("kind", thing.thing_class == "shelf" ? "shelf" : "obstacle");
    fields.set("id", std::uint64_t{thing.id}).set("class", thing.thing_class);
    fields.set("thing", thing.thing).set("gap", thing.gap).set("zone", zone(thing.lateral));
    fields.set("x", odometry_ ? odometry_->position.x : NAN);
    fields.set("y", odometry_ ? odometry_->position.y : NAN);
    events.push_back({type, fields, proximity.stamp, true});
  };
  for (const auto& thing : proximity.things) {
    const double range =
        thing.thing_class == "shelf" ? config_.shelf_range : config_.obstacle_range;
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

bool TrialMonitor::about_this_goal(const GuidanceReport& guidance) {
  using State = GuidanceReport::State;
  if (goal_taken_) return true;
  const bool refused = guidance.state == State::refused;
  const bool was_refused = guidance_before_ && guidance_before_->state == State::refused;
  const bool goal_matches = same(guidance.goal, start_->goal);
  if (refused) {
    // A refusal may be told with the goal that still stands.
    goal_taken_ = goal_matches || !was_refused;
  } else if (goal_matches && guidance.state == State::arrived && guidance_before_ &&
             same(guidance_before_->goal, start_->goal) &&
             guidance_before_->plans == guidance.plans) {
    goal_taken_ = guidance.stamp > start_->stamp + kOldNews;
  } else {
    goal_taken_ = goal_matches && (guidance.leads() || guidance.state == State::arrived ||
                                   guidance.state == State::no_route);
  }
  return goal_taken_;
}

std::vector<Event> TrialMonitor::observe(const GuidanceReport& guidance) {
  using State = GuidanceReport::State;
  const bool inside = counts(guidance.stamp);
  const auto last = guidance_;
  guidance_ = guidance;
  if (!inside) return {};
  if (last && guidance.seq > last->seq) tally_.missed_messages += guidance.seq - last->seq - 1;
  if (!about_this_goal(guidance)) return {};

  std::vector<Event> events;
  if (state_ != guidance.state) {
    state_ = guidance.state;
    events.push_back(
        {"GUIDANCE", Fields().set("state", to_string(guidance.state)), guidance.stamp});
  }
  // Only a guidance that was started anew forgets a goal that it had taken.
  if (guidance.state == State::no_goal) goal_taken_ = false;
  if (guidance.leads()) {
    if (!tally_.first_path_length) tally_.first_path_length = guidance.goal_distance;
    if (!plans_) {
      plans_ = guidance.plans;
      Fields fields;
      fields.set("first_path_length", guidance.goal_distance);
      events.push_back({"ROUTE", fields.set("plan_time", guidance.plan_time, 6), guidance.stamp});
    }
  }
  if (plans_ && guidance.plans < *plans_) plans_ = 0;  // a guidance that was started anew
  if (plans_ && guidance.plans > *plans_) {
    tally_.replans += guidance.plans - *plans_;
    plans_ = guidance.plans;
    Fields fields;
    fields.set("count", tally_.replans).set("reason", guidance.replan_reason);
    events.push_back(
        {"REPLAN", fields.set("plan_time", guidance.plan_time, 6), guidance.stamp, false});
  }
  if (guidance.state == State::arrived && !reached_) {
    reached_ = guidance.stamp;
    Fields fields = place();
    fields.set("elapsed", static_cast<double>(guidance.stamp - start_->stamp) * 1e-9);
    events.push_back({"GOAL_REACHED", fields, guidance.stamp});
  }
  if (guidance.state == State::refused && !refused_) {
    refused_ = guidance.refusal;
    events.push_back({"GOAL_REFUSED", Fields().set("reason", guidance.refusal), guidance.stamp});
  }
  return events;
}

std::vector<Event> TrialMonitor::observe(const CueReport& cue) {
  if (!counts(cue.stamp) || !cue.speech) return {};
  if (cue.stage == CueReport::Stage::started) ++tally_.cues_spoken;
  // However its speech fares, a cue that says stuck is the fact of being stuck.
  if (cue.kind != "stuck" || !stuck_cues_.insert(cue.id).second) return {};
  return {{"STUCK", place(), cue.stamp, true}};
}

std::vector<Event> TrialMonitor::observe(const DriveReport& drive) {
  const bool inside = counts(drive.stamp);
  const bool stopped_before = drive_ && drive_->stopped;
  drive_ = drive;
  if (!inside || drive.reason == "none" || !drive.stopped || stopped_before) return {};
  Fields fields = place();
  fields.set("reason", drive.reason).set("moved", tally_.path_length > kMoved ? "yes" : "no");
  return {{"SAFE_STOP", fields, drive.stamp, true}};
}

std::vector<Event> TrialMonitor::observe(const DeviceReport& device) {
  const bool inside = counts(device.stamp);
  const auto known = devices_.find(device.device);
  const bool changed = known != devices_.end() && known->second != device.usable;
  devices_[device.device] = device.usable;
  if (!inside || !changed) return {};
  Fields fields;
  fields.set("device", device.device);
  return {{device.usable ? "DEVICE_BACK" : "DEVICE_LOST", fields, device.stamp, true}};
}

std::vector<Event> TrialMonitor::observe(const StateReport& state) {
  latest_ = std::max(latest_, state.stamp);
  if (!end_ || state.stamp <= *end_) world_state_ = state;
  return {};
}

}  // namespace navvi_study
