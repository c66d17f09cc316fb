#include "navvi_nav/replan_policy.hpp"

namespace navvi_nav {

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
}

void ReplanPolicy::reset() {
  last_plan_.reset();
  last_slow_.reset();
  slow_since_.reset();
  near_.clear();
  near_pending_ = false;
}

bool ReplanPolicy::blocked(const Path& path, const std::vector<Cylinder>& obstacles) const {
  double left = config_.look_ahead;
  for (std::size_t i = 1; i < path.size() && left > 0.0; ++i) {
    const double length = distance(path[i - 1], path[i]);
    const double share = length > left ? left / length : 1.0;
    const Point end = path[i - 1] + share * (path[i] - path[i - 1]);
    left -= length;
    for (const Cylinder& obstacle : obstacles) {
      const double room = obstacle.radius + config_.robot_radius - config_.tolerance;
      if (distance(obstacle.center, nearest_on_segment(obstacle.center, path[i - 1], end)) < room)
        return true;
    }
  }
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
