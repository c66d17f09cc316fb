#include "guide/active_path.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kAhead = 20.0;     // m, of the path that counts
constexpr double kAside = 0.5;      // m, less is no change to a person
constexpr double kSample = 0.25;    // m
constexpr double kElsewhere = 2.0;  // m of a path that a new one leaves: the person is rerouted

}  // namespace

double moved_length(const Path& old, const Path& fresh) {
  if (fresh.empty()) return std::min(kAhead, length_of(old));
  double sum = 0.0;
  double before = 0.0;
  for (std::size_t i = 1; i < old.size() && before < kAhead; ++i) {
    const Point leg = old[i] - old[i - 1];
    const double length = norm(leg);
    const double counts = std::min(length, kAhead - before);
    before += length;
    if (counts <= 0.0) continue;
    const int samples = std::max(1, static_cast<int>(std::ceil(counts / kSample)));
    for (int k = 0; k < samples; ++k) {
      const double share = (k + 0.5) / samples * counts / length;
      if (away(old[i - 1] + share * leg, fresh) > kAside) sum += counts / samples;
    }
  }
  return sum;
}

void ActivePathConfig::describe(navvi_config::Visitor& visit) { visit.group("guidance", guidance); }

double ActivePath::follow(const plan::Plan& plan, Guidance::Replan reason,
                          std::optional<Point> robot) {
  const bool retreat = plan.status == plan::PlanStatus::retreat;
  double moved = 0.0;
  if (following() && robot) {
    moved = moved_length(remaining(*robot), plan.path);
    if (moved > kElsewhere && leads_to_goal_ && !retreat) {
      ++reroutes_;
      reroute_reason_ = reason;
    }
  }
  follower_.follow(plan.path);
  leads_to_goal_ = !retreat;
  if (!retreat) ends_short_ = plan.ends_short;
  shortest_length_ = plan.shortest;
  if (plan.status == plan::PlanStatus::found)
    mode_ = PathMode::to_goal;
  else if (retreat)
    mode_ = PathMode::retreat;
  else if (mode_ != PathMode::waiting)
    mode_ = PathMode::closed;
  return moved;
}

void ActivePath::reset() {
  drop();
  mode_ = PathMode::to_goal;
  ends_short_ = false;
  reroutes_ = 0;
  reroute_reason_ = Guidance::Replan::none;
}

double ActivePath::offset(Point robot) const { return following() ? follower_.offset(robot) : 0.0; }

bool ActivePath::arrived(Point robot, const map::Space& space) const {
  return leads_to_goal_ && mode_ != PathMode::waiting && follower_.arrived(robot, space);
}

void ActivePath::report(Guidance& out, const Pose2& robot, const map::Floor& floor,
                        double pace) const {
  follower_.report(out, robot, floor);
  out.ends_short = ends_short_;
  if (!leads_to_goal_ || ends_short_) out.waypoint_is_goal = false;
  if (!leads_to_goal_) out.goal_distance += distance(follower_.path().back(), to_point(out.goal));
  out.eta = out.goal_distance / pace;
  out.shortest_length = shortest_length_;
}

void ActivePath::report_changes(Guidance& out) const {
  out.reroutes = reroutes_;
  out.reroute_reason = reroute_reason_;
}

}  // namespace navvi_nav::guide
