#include "navvi_nav/replan_policy.hpp"

namespace navvi_nav {
namespace {

constexpr double kMoved = 0.1;  // m, what moved less has not left its place
constexpr double kLetGo = 0.5;  // s, who was told to wait goes on only after it was clear so long
constexpr double kBack = 120.0 / 180 * M_PI;  // rad, from the course that is followed
constexpr double kCourse = 1.0;               // m, how much of a path makes its course
constexpr double kHole = 0.2;  // m, of a hole beyond the obstacle and the robot on its rim

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

bool leads_back(const Path& followed, const Path& fresh) {
  const Point a = course_of(followed);
  const Point b = course_of(fresh);
  return std::abs(std::atan2(cross(a, b), dot(a, b))) > kBack;
}

}  // namespace

void ReplanPolicyConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"period", Range{0.1, 60.0}, "s", "tau: a plan is made again at least so often (R-NAV-9)"},
        period);
  visit({"slow_speed", Range{0.0, 1.0}, "m/s", "slower than this counts as too slow"}, slow_speed);
  visit({"slow_time", Range{0.0, 60.0}, "s", "how long the robot must be too slow"}, slow_time);
  visit({"near_range", Range{0.0, 20.0}, "m",
         "R_threshold: a new obstacle within this distance of the robot is a reason"},
        near_range);
  visit({"min_interval", Range{0.0, 10.0}, "s", "least time between plans because of obstacles"},
        min_interval);
  visit({"only_if_it_matters", navvi_config::Any{}, "",
         "search for a path that is still free only if something left a place through which a "
         "better one could lead, or the robot strayed"},
        only_if_it_matters);
  visit({"stray", Range{0.0, 10.0}, "m", "a robot so far off its path strayed"}, stray);
  visit({"gain", Range{0.0, 1.0}, "",
         "share by which a new path must be shorter to replace one that is still free"},
        gain);
  visit({"gain_length", Range{0.0, 10.0}, "m", "length by which it must be shorter besides"},
        gain_length);
  visit({"gain_back", Range{0.0, 100.0}, "m", "and by so much more if it leads back"}, gain_back);
  way.describe(visit);
  hold.describe(visit);
}

void ReplanPolicy::reset() {
  last_plan_.reset();
  last_slow_.reset();
  slow_since_.reset();
  hold_.reset();
  way_ = {};
  wait_.reset();
  near_.clear();
  near_pending_ = false;
}

bool ReplanPolicy::holds(double time, const Path& followed, const Path& fresh,
                         const std::vector<Cylinder>& obstacles, double pace) {
  return hold_.keeps(time, {followed, ahead_.judge(followed, obstacles, pace)},
                     {fresh, ahead_.judge(fresh, obstacles, pace)});
}

std::optional<Way::Wait> ReplanPolicy::closed_by(const Path& path,
                                                 const std::vector<Cylinder>& obstacles) const {
  const std::optional<WayAhead::Cut> cut = ahead_.first_cut(path, obstacles);
  const bool tells = cut && (way_.state == Way::State::comes || hold_.is_near(cut->at));
  return tells ? std::optional(Way::Wait{cut->by, cut->at, -1.0}) : std::nullopt;
}

std::vector<Cylinder> ReplanPolicy::foreseen(const Path& path,
                                             const std::vector<Cylinder>& obstacles,
                                             double pace) const {
  if (config_.hold.hold_time <= 0.0) return {};
  return ahead_.foreseen(path, obstacles, pace);
}

std::optional<Reason> ReplanPolicy::update(const ReplanInput& input) {
  if (!input.has_goal) {
    reset();
    return std::nullopt;
  }
  if (input.speed >= config_.slow_speed) {
    slow_since_.reset();
  } else if (!slow_since_) {
    slow_since_ = input.time;
  }
  const bool slow = slow_since_ && input.time - *slow_since_ > config_.slow_time &&
                    (!last_slow_ || input.time - *last_slow_ >= config_.period);
  near_pending_ = note_near(input) || near_pending_;
  way_ = ahead_.judge(input.remaining, input.obstacles, input.pace);
  if (hold_.must_wait(way_)) {
    wait_ = way_.wait;
    wait_time_ = input.time;
  } else if (input.time - wait_time_ > kLetGo) {
    wait_.reset();
  }
  const std::optional<Reason> reason = choose(input, slow, hold_.waits(input.time, way_));
  if (!reason) return reason;
  last_plan_ = input.time;
  near_pending_ = false;
  if (slow) last_slow_ = input.time;
  interest_.searched(input.obstacles);
  return reason;
}

/// True if something is near that was not at the last update.
bool ReplanPolicy::note_near(const ReplanInput& input) {
  std::set<std::uint32_t> near;
  bool fresh = false;
  for (const Cylinder& obstacle : input.obstacles) {
    if (distance(obstacle.center, input.robot.position) > config_.near_range + obstacle.radius)
      continue;
    near.insert(obstacle.id);
    fresh = fresh || near_.count(obstacle.id) == 0;
  }
  near_ = std::move(near);
  return fresh;
}

/// False if a search could only find the path that is followed, or none that is worth changing to.
bool ReplanPolicy::matters(const ReplanInput& input) const {
  if (!config_.only_if_it_matters || input.remaining.size() < 2 ||
      input.path_offset > config_.stray)
    return true;
  return interest_.better_way(input.robot.position, input.remaining.back(),
                              worthwhile(length_of(input.remaining)), input.obstacles, kMoved,
                              config_.way.robot_radius + kHole);
}

std::optional<Reason> ReplanPolicy::choose(const ReplanInput& input, bool slow, bool waits) {
  if (input.new_goal || !last_plan_) return Reason::new_goal;
  if (input.map_changed) return Reason::map_changed;
  const double since = input.time - *last_plan_;
  if (since < std::min(config_.min_interval, config_.period)) return std::nullopt;
  if (since >= config_.min_interval && !waits && !input.closed && input.remaining.size() >= 2) {
    const Point next = input.remaining[1];
    if (distance(input.robot.position, next) <= config_.way.look_ahead &&
        ahead_.taken(next, input.obstacles))
      return Reason::waypoint_blocked;
    const bool avoids =
        config_.hold.hold_time > 0.0 && since >= config_.period &&
        (way_.state == Way::State::comes || (way_.hits_waiting && std::isfinite(way_.hits_in)));
    if (avoids || blocked(input.remaining, input.obstacles)) return Reason::path_carved;
  }
  if (!near_pending_ && !slow && since < config_.period) return std::nullopt;
  if (!input.closed && !matters(input)) {
    near_pending_ = false;
    return std::nullopt;
  }
  if (since >= config_.min_interval && near_pending_) return Reason::obstacle_near;
  if (since >= config_.min_interval && slow) return Reason::too_slow;
  if (since >= config_.period) return Reason::period;
  return std::nullopt;
}

bool ReplanPolicy::worth_changing(Reason reason, const Path& followed, const Path& fresh) const {
  if (reason != Reason::period && reason != Reason::too_slow && reason != Reason::obstacle_near)
    return true;
  if (fresh.size() < 2) return false;
  const double back = leads_back(followed, fresh) ? config_.gain_back : 0.0;
  return length_of(fresh) + back < worthwhile(length_of(followed));
}

}  // namespace navvi_nav
