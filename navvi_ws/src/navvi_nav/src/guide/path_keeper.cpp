#include "guide/path_keeper.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kLetGo = 0.5;        // s, that it must be clear before a wait ends
constexpr double kHoldMeeting = 4.0;  // s, what is met later may turn off
constexpr double kBack = navvi_types::radians(120.0);  // rad, from the course that is followed
constexpr double kCourse = 1.0;                        // m, how much of a path makes its course
constexpr double kSafer = 1.0;                         // s, by which a collision must be later

/// From the path's start to the point kCourse along it.
Point course_of(const Path& path) {
  double left = kCourse;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = distance(path[i - 1], path[i]);
    if (length >= left)
      return path[i - 1] + (left / length) * (path[i] - path[i - 1]) - path.front();
    left -= length;
  }
  return path.back() - path.front();
}

bool safer(const PathKeeper::Candidate& followed, const PathKeeper::Candidate& fresh) {
  return fresh.path.size() >= 2 &&
         fresh.conflict.time_to_collision > followed.conflict.time_to_collision + kSafer;
}

bool leads_back(const Path& followed, const Path& fresh) {
  const Point a = course_of(followed);
  const Point b = course_of(fresh);
  return std::abs(std::atan2(cross(a, b), dot(a, b))) > kBack;
}

}  // namespace

void PathKeeperConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(gain, "gain", Range{0.0, 1.0}, "",
        "share by which a new path must be shorter to replace one that is still free");
  visit(gain_length, "gain_length", Range{0.0, 10.0}, "m",
        "length by which it must also be shorter");
  visit(gain_back, "gain_back", Range{0.0, 100.0}, "m",
        "additional length by which it must be shorter if it leads back");
  visit(hold_time, "hold_time", Range{0.0, 60.0}, "s",
        "longest time to keep a path on which a collision is predicted; 0: replan at once");
}

bool PathKeeper::update(double time, const Conflict& conflict) {
  if (must_wait(conflict)) {
    wait_ = conflict.wait_for;
    wait_time_ = time;
  } else if (time - wait_time_ > kLetGo) {
    wait_.reset();
  }
  if (goes_on_safely(conflict)) return true;
  if (conflict.state == Conflict::State::crossing || waits_safely(conflict))
    return goes_on(time, true) && !conflict.hits_either_way();
  if (conflict.state != Conflict::State::oncoming) since_.reset();
  return false;
}

bool PathKeeper::decide(const Choice& choice) {
  const Candidate none;
  const Candidate& fresh = choice.found == plan::PlanStatus::found ? choice.fresh : none;
  const bool held = choice.mode == PathMode::to_goal && holds(choice.time, choice.followed, fresh);
  if (choice.reason == Guidance::Replan::new_goal ||
      choice.reason == Guidance::Replan::map_changed || choice.strayed)
    return false;
  if (held) return choice.sees_waypoint;
  const Conflict& conflict = choice.followed.conflict;
  const bool cut = conflict.cut || conflict.waypoint_taken;
  if (!choice.sees_waypoint) return false;
  if (choice.found == plan::PlanStatus::retreat) return choice.mode == PathMode::retreat && !cut;
  if (choice.found == plan::PlanStatus::closed)
    return choice.mode == PathMode::closed && !shorter(choice.followed.path, choice.fresh.path);
  const bool leads =
      choice.mode == PathMode::to_goal || (holds_paths() && choice.mode == PathMode::closed);
  const bool evades = choice.reason == Guidance::Replan::path_carved ||
                      choice.reason == Guidance::Replan::waypoint_blocked;
  const bool better = evades ? !holds_paths() || safer(choice.followed, fresh)
                             : shorter(choice.followed.path, fresh.path);
  return leads && !cut && choice.way_is_free && !better;
}

/// True to keep the path although `fresh` is at hand: as update(), or nothing is hit within
/// hold_choice, while `fresh` leads in front of something that moves. A path that was chosen within
/// hold_choice is left only for one that is safer.
bool PathKeeper::holds(double time, const Candidate& followed, const Candidate& fresh) {
  const Conflict& conflict = followed.conflict;
  if (goes_on_safely(conflict)) return true;
  const bool far_round = conflict.state == Conflict::State::oncoming &&
                         length_of(fresh.path) > length_of(followed.path) + config_.hold_detour;
  const bool passes =
      conflict.state == Conflict::State::crossing || waits_safely(conflict) || far_round;
  if (goes_on(time, passes && !(conflict.hits_either_way() && safer(followed, fresh)))) return true;
  if (!holds_paths()) return false;
  const bool in_time = conflict.time_to_collision > config_.kHoldChoice;
  if (chosen_ && time - *chosen_ < config_.kHoldChoice)
    return in_time || (fresh.path.size() >= 2 && !safer(followed, fresh));
  return in_time && fresh.path.size() >= 2 &&
         fresh.conflict.time_to_collision <= config_.kHoldChoice;
}

/// Remembers since when a conflict is sat out. \returns true for at most hold_time
bool PathKeeper::goes_on(double time, bool held) {
  if (!held) {
    since_.reset();
    return false;
  }
  if (!since_) since_ = time;
  return time - *since_ < config_.hold_time;
}

void PathKeeper::reset() {
  since_.reset();
  chosen_.reset();
  wait_.reset();
}

std::optional<Blocker> PathKeeper::blocker(const std::optional<Conflict::Cut>& cut,
                                           Conflict::State state) const {
  if (!cut || (state != Conflict::State::oncoming && !is_near(cut->at))) return std::nullopt;
  return Blocker{cut->by, cut->at, std::nullopt};
}

bool PathKeeper::evades(const Conflict& conflict) const {
  return holds_paths() &&
         (conflict.state == Conflict::State::oncoming || conflict.hits_either_way());
}

bool PathKeeper::shorter(const Path& followed, const Path& fresh) const {
  if (fresh.size() < 2) return false;
  const double back = leads_back(followed, fresh) ? config_.gain_back : 0.0;
  return length_of(fresh) + back < worthwhile(length_of(followed));
}

bool PathKeeper::must_wait(const Conflict& conflict) const {
  return holds_paths() && conflict.wait_for && is_near(conflict.wait_for->at);
}

bool PathKeeper::waits_safely(const Conflict& conflict) const {
  return must_wait(conflict) && !conflict.hits_waiting;
}

bool PathKeeper::goes_on_safely(const Conflict& conflict) {
  if (!holds_paths() || conflict.state == Conflict::State::clear ||
      conflict.state == Conflict::State::stationary)
    return false;
  const bool safely = !conflict.hits_waiting && !std::isfinite(conflict.time_to_collision);
  if (safely) since_.reset();
  return safely ||
         (conflict.state == Conflict::State::oncoming && conflict.time_to_meeting > kHoldMeeting);
}

}  // namespace navvi_nav::guide
