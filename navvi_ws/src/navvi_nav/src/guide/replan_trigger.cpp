#include "guide/replan_trigger.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kSameGoal = 0.5;  // m

bool same(Point a, Point b) { return distance(a, b) <= kSameGoal; }

constexpr double kMoved = 0.1;  // m, an obstacle that moved less has not left its place
constexpr double kStray = 0.5;  // m, a robot farther off its path strayed
constexpr double kHole = 0.2;   // m, of a hole beyond the obstacle and the robot on its rim

}  // namespace

bool SecondAsk::agrees(Point goal, double stamp) {
  if (agreed_ && stamp == agreed_->stamp && same(goal, agreed_->place)) return true;
  if (!refused_ || !(stamp > refused_->stamp)) return false;
  const bool again = same(goal, refused_->place);
  refused_.reset();
  if (again) agreed_ = {goal, stamp};
  return again;
}

void SecondAsk::refused(Point goal, Guidance::Refusal why, double heard) {
  if (agreed_ && same(goal, agreed_->place)) agreed_.reset();
  if (why == Guidance::Refusal::not_seen || why == Guidance::Refusal::off_the_map)
    refused_ = {goal, heard};
}

void SecondAsk::reset() {
  refused_.reset();
  agreed_.reset();
}

void ReplanTriggerConfig::describe(navvi_config::Visitor& visit) {
  visit(period, "period", navvi_config::Range{0.1, 60.0}, "s",
        "tau: a plan is made again at least so often (R-NAV-9)");
  visit(near_range, "near_range", navvi_config::Range{0.0, 20.0}, "m",
        "R_threshold: a new obstacle within this distance of the robot is a reason");
  visit(only_if_it_matters, "only_if_it_matters", navvi_config::Any{}, "",
        "search for a path that is still free only if something left a place through which a "
        "better one could lead, or the robot strayed");
}

void ReplanTrigger::reset() {
  last_plan_.reset();
  last_slow_.reset();
  slow_since_.reset();
  near_.clear();
  near_pending_ = false;
}

std::optional<Guidance::Replan> ReplanTrigger::update(const ReplanInput& input) {
  const bool slow = is_slow(input);
  near_pending_ = note_near(input) || near_pending_;
  const std::optional<Guidance::Replan> reason = choose(input, slow);
  if (!reason) return reason;
  last_plan_ = input.time;
  near_pending_ = false;
  if (slow) last_slow_ = input.time;
  searched_ = input.obstacles;
  return reason;
}

/// True if the robot has been too slow for too long, at most once a period.
bool ReplanTrigger::is_slow(const ReplanInput& input) {
  if (input.speed >= config_.kSlowSpeed) {
    slow_since_.reset();
  } else if (!slow_since_) {
    slow_since_ = input.time;
  }
  return slow_since_ && input.time - *slow_since_ > config_.kSlowTime &&
         (!last_slow_ || input.time - *last_slow_ >= config_.period);
}

/// True if something is near that was not at the last update.
bool ReplanTrigger::note_near(const ReplanInput& input) {
  std::set<std::uint32_t> near;
  bool fresh = false;
  for (const Cylinder& obstacle : input.obstacles) {
    if (distance(obstacle.center, input.robot) > config_.near_range + obstacle.radius) continue;
    near.insert(obstacle.id);
    fresh = fresh || near_.count(obstacle.id) == 0;
  }
  near_ = std::move(near);
  return fresh;
}

/// False if a search could only find the path that is followed, or none that is worth changing to.
bool ReplanTrigger::matters(const ReplanInput& input) const {
  if (!config_.only_if_it_matters || input.remaining.size() < 2 || input.path_offset > kStray)
    return true;
  return may_have_opened(input);
}

/// True if obstacles that moved since the last search could have opened a path that is worthwhile.
/// A path through the place that one of them left runs through a point of its hole; all points
/// through which a path of a given length can lead fill the ellipse about its ends: the informed
/// set (Gammell, Srinivasa and Barfoot, "Informed RRT*", 2014).
bool ReplanTrigger::may_have_opened(const ReplanInput& input) const {
  const Point goal = input.remaining.back();
  if (distance(input.robot, goal) >= input.worthwhile) return false;
  return std::any_of(searched_.begin(), searched_.end(), [&](const Cylinder& hole) {
    const double reach = hole.radius + (config_.robot_radius + kHole);
    if (distance(input.robot, hole.center) + distance(hole.center, goal) - 2.0 * reach >=
        input.worthwhile)
      return false;
    return std::none_of(input.obstacles.begin(), input.obstacles.end(),
                        [&](const Cylinder& obstacle) {
                          return obstacle.id == hole.id && obstacle.radius >= hole.radius &&
                                 distance(obstacle.center, hole.center) < kMoved;
                        });
  });
}

std::optional<Guidance::Replan> ReplanTrigger::choose(const ReplanInput& input, bool slow) {
  if (input.new_goal || !last_plan_) return Guidance::Replan::new_goal;
  if (input.map_changed) return Guidance::Replan::map_changed;
  const double since = input.time - *last_plan_;
  if (since < std::min(config_.kMinInterval, config_.period)) return std::nullopt;
  if (input.cut_off) return Guidance::Replan::waypoint_blocked;
  if (since >= config_.kMinInterval && !input.kept && !input.closed &&
      input.remaining.size() >= 2) {
    if (input.conflict.waypoint_taken) return Guidance::Replan::waypoint_blocked;
    if ((input.evades && since >= config_.period) || input.conflict.cut)
      return Guidance::Replan::path_carved;
  }
  if (!near_pending_ && !slow && since < config_.period) return std::nullopt;
  if (!input.closed && !matters(input)) {
    near_pending_ = false;
    return std::nullopt;
  }
  if (since >= config_.kMinInterval && near_pending_) return Guidance::Replan::obstacle_near;
  if (since >= config_.kMinInterval && slow) return Guidance::Replan::too_slow;
  if (since >= config_.period) return Guidance::Replan::period;
  return std::nullopt;
}

}  // namespace navvi_nav::guide
