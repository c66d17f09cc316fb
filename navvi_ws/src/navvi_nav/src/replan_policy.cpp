#include "navvi_nav/replan_policy.hpp"

namespace navvi_nav {
namespace {

constexpr double kMoving = 0.2;               // m/s, what is slower stands
constexpr double kDetour = 1.5;               // times the length of the path that is followed
constexpr double kDetourLength = 5.0;         // m longer
constexpr double kBack = 120.0 / 180 * M_PI;  // rad, from the course that is followed
constexpr double kCourse = 1.0;               // m, how much of a path makes its course

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

bool is_detour(const Path& followed, const Path& fresh) {
  if (fresh.size() < 2) return true;
  const double length = length_of(followed);
  const double fresh_length = length_of(fresh);
  if (fresh_length > kDetour * length || fresh_length > length + kDetourLength) return true;
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
  visit({"tolerance", Range{0.0, 0.5}, "m", "how far an obstacle may reach into the path's room"},
        tolerance);
  visit({"look_ahead", Range{0.5, 1e6}, "m",
         "obstacles on the path farther ahead than this are left to move away"},
        look_ahead);
  visit({"gain", Range{0.0, 1.0}, "",
         "share by which a new path must be shorter to replace one that is still free"},
        gain);
  visit({"gain_length", Range{0.0, 10.0}, "m", "length by which it must be shorter besides"},
        gain_length);
  visit({"hold_time", Range{0.0, 60.0}, "s",
         "a path cut by moving things is kept so long before a detour is taken; 0: never kept"},
        hold_time);
  visit({"hold_distance", Range{0.0, 100.0}, "m",
         "a path cut within this distance of the robot is not kept"},
        hold_distance);
}

void ReplanPolicy::reset() {
  last_plan_.reset();
  last_slow_.reset();
  slow_since_.reset();
  held_since_.reset();
  near_.clear();
  near_pending_ = false;
}

std::optional<double> ReplanPolicy::cut_at(const Path& path, const Cylinder& obstacle) const {
  const double room = obstacle.radius + config_.robot_radius - config_.tolerance;
  double before = 0.0;
  for (std::size_t i = 1; i < path.size() && before < config_.look_ahead; ++i) {
    const double left = config_.look_ahead - before;
    const double length = distance(path[i - 1], path[i]);
    const double share = length > left ? left / length : 1.0;
    const Point end = path[i - 1] + share * (path[i] - path[i - 1]);
    const Point nearest = nearest_on_segment(obstacle.center, path[i - 1], end);
    const double gap = distance(obstacle.center, nearest);
    if (gap < room) {
      const double chord = std::sqrt(room * room - gap * gap);
      return before + std::max(0.0, distance(path[i - 1], nearest) - chord);
    }
    before += length;
  }
  return std::nullopt;
}

bool ReplanPolicy::blocked(const Path& path, const std::vector<Cylinder>& obstacles) const {
  return std::any_of(obstacles.begin(), obstacles.end(),
                     [&](const Cylinder& obstacle) { return cut_at(path, obstacle).has_value(); });
}

/// True if something cuts the path, and all that does is moving and far enough, and leaves the
/// next way-point free.
bool ReplanPolicy::may_clear(const Path& path, const std::vector<Cylinder>& obstacles) const {
  if (path.size() < 2 || blocked({path[1], path[1]}, obstacles)) return false;
  bool cut = false;
  for (const Cylinder& obstacle : obstacles) {
    const std::optional<double> at = cut_at(path, obstacle);
    if (!at) continue;
    if (*at <= config_.hold_distance || norm(obstacle.velocity) <= kMoving) return false;
    cut = true;
  }
  return cut;
}

bool ReplanPolicy::holds(double time, const Path& followed, const Path& fresh,
                         const std::vector<Cylinder>& obstacles) {
  if (may_clear(followed, obstacles) && is_detour(followed, fresh)) {
    if (!held_since_) held_since_ = time;
    if (time - *held_since_ < config_.hold_time) return true;
  }
  held_since_.reset();
  return false;
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

  std::set<std::uint32_t> near;
  for (const Cylinder& obstacle : input.obstacles) {
    if (distance(obstacle.center, input.robot.position) > config_.near_range + obstacle.radius)
      continue;
    near.insert(obstacle.id);
    near_pending_ = near_pending_ || near_.count(obstacle.id) == 0;
  }
  near_ = std::move(near);

  const std::optional<Reason> reason = choose(input, slow, near_pending_);
  if (!reason) return reason;
  last_plan_ = input.time;
  near_pending_ = false;
  if (slow) last_slow_ = input.time;
  return reason;
}

std::optional<Reason> ReplanPolicy::choose(const ReplanInput& input, bool slow,
                                           bool fresh_near) const {
  if (input.new_goal || !last_plan_) return Reason::new_goal;
  if (input.map_changed) return Reason::map_changed;
  const double since = input.time - *last_plan_;
  if (since >= config_.min_interval) {
    if (input.remaining.size() >= 2) {
      const Point next = input.remaining[1];
      if (blocked({next, next}, input.obstacles)) return Reason::waypoint_blocked;
      if (blocked(input.remaining, input.obstacles)) return Reason::path_carved;
    }
    if (fresh_near) return Reason::obstacle_near;
    if (slow) return Reason::too_slow;
  }
  if (since >= config_.period) return Reason::period;
  return std::nullopt;
}

bool ReplanPolicy::worth_changing(Reason reason, double followed, double fresh) const {
  if (reason != Reason::period && reason != Reason::too_slow && reason != Reason::obstacle_near)
    return true;
  return fresh < followed * (1.0 - config_.gain) - config_.gain_length;
}

}  // namespace navvi_nav
