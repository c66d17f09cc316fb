#include "guide/path_follower.hpp"

#include "smooth/turns.hpp"

namespace navvi_nav::guide {
namespace {

constexpr double kNearPath = 1.5;  // m, a robot farther off steers for the way-point itself
constexpr double kSlack = 0.02;    // m, of room that need not be kept
constexpr double kCut = 0.2;       // m, a leg with less room is cut
constexpr double kSample = 0.1;    // m
constexpr double kShorter = 0.8;   // of the way to steer for, at each try
constexpr double kOnPath = 0.5;    // m, a robot nearer to a later leg has passed its start
const std::vector<Cylinder> kNone;

/// m, from the segment to the nearest thing, sampled; `most` at most.
double least_room(Point a, Point b, const map::Space& space, double most = map::Floor::kFar) {
  const int samples = std::max(1, static_cast<int>(std::ceil(distance(a, b) / kSample)));
  double least = space.clearance(a, most);
  for (int i = 1; i <= samples; ++i)
    least = space.clearance(a + (1.0 * i / samples) * (b - a), least);
  return least;
}

}  // namespace

void PathFollowerConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(waypoint_reached, "waypoint_reached", Range{0.1, 5.0}, "m",
        "a way-point counts as reached (R-NAV-8)");
  visit(goal_reached, "goal_reached", Range{0.1, 5.0}, "m",
        "the goal counts as reached (R-NAV-11)");
  visit(sight_radius, "sight_radius", Range{0.0, 1.0}, "m",
        "room that the straight way to a way-point must have before the one before is given up; "
        "at least 0.05 m more than mesh/robot_radius; 0: none");
  visit(easy_radius, "easy_radius", Range{0.0, 2.0}, "m",
        "the same while the robot is not yet close; at least 0.25 m more; 0: none");
  visit(one_turn, "one_turn", Range{0.0, 5.0}, "m",
        "corners nearer than this to the one before are announced as one turn with it, and bends "
        "below 15 degrees not at all; 0: each corner is");
  visit(
      steer_ahead, "steer_ahead", Range{0.5, 1e6}, "m",
      "directions are to the path so far ahead of the robot, or to the way-point if it is nearer");
  visit(least_ahead, "least_ahead", Range{0.1, 1e6}, "m",
        "or to a nearer point of the path, but not nearer than this, if what stands is in between");
}

void PathFollower::follow(const Path& path) {
  path_ = path.size() >= 2 ? path : Path{};
  next_ = path_.empty() ? 0 : 1;
}

Path PathFollower::remaining(Point robot) const {
  Path out;
  if (!following()) return out;
  out.push_back(robot);
  out.insert(out.end(), path_.begin() + static_cast<std::ptrdiff_t>(next_), path_.end());
  return out;
}

bool PathFollower::sees(Point robot, Point target, const map::Space& space) const {
  // A robot that already stands nearer to something must still be able to drive on.
  const double own = space.clearance(robot) - kSlack;
  return space.segment_clear(robot, target, std::max(0.0, std::min(config_.sight_radius, own)));
}

bool PathFollower::reached(Point robot, const map::Space& space) const {
  const double away = distance(robot, path_[next_]);
  if (away > config_.waypoint_reached) return false;
  const Point after = path_[next_ + 1];
  if (space.segment_clear(robot, after, config_.easy_radius)) return true;
  return away <= config_.kClose && leaves_corner(robot, space);
}

/// True if a robot close to the next way-point may turn to the one after. More room than the leg
/// between them has is not asked for, and where an obstacle stands in that leg, the robot can wait
/// for it at the corner as well as anywhere.
bool PathFollower::leaves_corner(Point robot, const map::Space& space) const {
  const Point corner = path_[next_];
  const Point after = path_[next_ + 1];
  if (sees(robot, after, space)) return true;
  const bool cut = least_room(corner, after, space) < kCut;
  const map::Space known = cut ? map::Space{space.floor, &kNone} : space;
  const double room = std::min(known.clearance(robot), least_room(corner, after, known)) - kSlack;
  return room > 0.0 && known.segment_clear(robot, after, std::min(room, config_.sight_radius));
}

void PathFollower::advance(Point at, const map::Space& space) {
  while (next_ + 1 < path_.size() && reached(at, space)) ++next_;

  std::size_t nearest = next_ - 1;  // leg
  double best = distance(at, nearest_on_segment(at, path_[nearest], path_[next_]));
  for (std::size_t leg = next_; leg + 1 < path_.size(); ++leg) {
    const double away = distance(at, nearest_on_segment(at, path_[leg], path_[leg + 1]));
    if (away < best - 1e-6) {
      best = away;
      nearest = leg;
    }
  }
  if (nearest >= next_ && best <= kOnPath && sees(at, path_[nearest + 1], space))
    next_ = nearest + 1;
}

bool PathFollower::arrived(Point robot, const map::Space& space) const {
  if (!following() || distance(robot, path_.back()) > config_.goal_reached) return false;
  return space.floor->segment_clear(robot, path_.back(), 0.0);
}

/// Towards a far way-point a drift off the path shows too late; a nearer point turns the same drift
/// into a larger angle. A robot beside its path, next to a corner or a wall, is led off that first.
Point PathFollower::steer_point(Point robot, const map::Floor& floor) const {
  const Point start = path_[next_ - 1];
  const Point leg = path_[next_] - start;
  const Point nearest = nearest_on_segment(robot, start, path_[next_]);
  const double left = distance(nearest, path_[next_]);
  if (distance(robot, nearest) > kNearPath) return path_[next_];
  const auto ahead = [&](double by) {
    return by < left ? nearest + (by / norm(leg)) * leg : path_[next_];
  };
  const map::Space still{&floor, &kNone};
  const double own = still.clearance(robot, config_.sight_radius + 2.0 * kSlack);
  const auto free = [&](Point target) {
    const double room = least_room(nearest, target, still, own) - kSlack;
    return still.segment_clear(robot, target, std::clamp(room, 0.0, config_.sight_radius));
  };
  double by = std::min(left, config_.steer_ahead);
  while (by > config_.least_ahead && !free(ahead(by)))
    by = std::max(config_.least_ahead, kShorter * by);
  return ahead(by);
}

bool PathFollower::cut_off(Point robot, const map::Floor& floor) const {
  const Point nearest = nearest_on_segment(robot, path_[next_ - 1], path_[next_]);
  return floor.clearance(robot, kCut) > 0.0 && !floor.segment_clear(robot, nearest, 0.0) &&
         !floor.segment_clear(robot, steer_point(robot, floor), 0.0);
}

void PathFollower::report(Guidance& out, const Pose2& robot, const map::Floor& floor) const {
  const Point at = to_point(robot.position);
  const Point ahead{std::cos(robot.yaw), std::sin(robot.yaw)};
  const Path left(path_.begin() + static_cast<std::ptrdiff_t>(next_) - 1, path_.end());
  const smooth::Turn turn = smooth::turns_of(left, config_.one_turn).front();
  const Point place = left[turn.at];
  out.waypoint = {place.x, place.y};
  out.waypoint_is_goal = turn.at + 1 == left.size();
  out.waypoint_distance = distance(at, place);
  out.waypoint_angle = clockwise(ahead, place - at);
  out.steer_angle = clockwise(ahead, steer_point(at, floor) - at);
  out.turn_angle = turn.angle;
  out.goal_distance = length_of(remaining(at));
  out.path_offset = offset(at);
}

}  // namespace navvi_nav::guide
