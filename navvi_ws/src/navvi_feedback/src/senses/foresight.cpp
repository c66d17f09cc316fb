#include "senses/foresight.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>

namespace navvi_feedback::senses {
namespace {

constexpr double kLongest = 5.0;     // s, of a round trip
constexpr double kSteerAhead = 3.0;  // m, at most to the point that is steered for, as in navigation
constexpr double kAt = 0.5;          // m; the direction to what is nearer says nothing

/// rad, clockwise, from the nose of a robot at `ahead` to a point that was seen from `robot`, both
/// in map; past it, to where it lay.
double angle_to(const Eigen::Vector2d& point, const navvi_types::Pose2& robot,
                const navvi_types::Pose2& ahead) {
  const Eigen::Vector2d before = point - robot.position, left = point - ahead.position;
  const Eigen::Vector2d way = left.norm() > kAt && left.dot(before) > 0.0 ? left : before;
  return navvi_types::wrap(ahead.yaw - std::atan2(way.y(), way.x()));
}

}  // namespace

void Foresight::sent(const Velocity& command, double time) {
  sent_.emplace_back(time, command);
  while (time - sent_.front().first > kLongest) sent_.pop_front();
}

Velocity Foresight::at(double time) const {
  Velocity held;
  for (const auto& [from, command] : sent_)
    if (from <= time) held = command;
  return held;
}

navvi_types::Pose2 Foresight::moved(double over, double time) const {
  navvi_types::Pose2 place;
  double from = time - over;
  Velocity held = at(from);
  const auto drive_until = [&](double until) {
    const double turn = held.angular * (until - from);
    const double course = place.yaw + 0.5 * turn;
    place.position += held.linear * (until - from) *
                      Eigen::Vector2d(std::cos(course), std::sin(course));
    place.yaw += turn;
    from = until;
  };
  for (const auto& [begin, command] : sent_) {
    if (begin <= from) continue;
    drive_until(begin);
    held = command;
  }
  drive_until(time);
  return place;
}

navvi_types::Pose2 Foresight::place(const navvi_types::Pose2& robot, double over,
                                    double time) const {
  const navvi_types::Pose2 ahead = moved(over, time);
  return {robot.to_parent(ahead.position), robot.yaw + ahead.yaw};
}

void Foresight::look_ahead(Observation& now, const std::optional<navvi_types::Pose2>& robot,
                           double over, double time) const {
  const Velocity then = at(time - over), last = at(time);
  now.last_measured.linear += last.linear - then.linear;
  now.last_measured.angular += last.angular - then.angular;
  if (now.measured) now.measured = now.last_measured;
  const navvi_types::Pose2 ahead = moved(over, time);
  if (now.guidance && now.guidance->leads() && robot) {
    Guidance& way = *now.guidance;
    const navvi_types::Pose2 then_at = place(*robot, over, time);
    const double far = std::clamp(way.waypoint_distance, kAt, kSteerAhead);
    const double course = robot->yaw - now.turned - way.steer_angle;
    const Eigen::Vector2d steer_for =
        robot->position + far * Eigen::Vector2d(std::cos(course), std::sin(course));
    way.steer_angle = angle_to(steer_for, *robot, then_at);
    way.waypoint_angle = angle_to(way.waypoint, *robot, then_at);
    way.waypoint_distance = (way.waypoint - then_at.position).norm();
    way.goal_distance = std::max(0.0, way.goal_distance - std::max(0.0, ahead.position.x()));
    now.turned = 0.0;
  } else {
    now.turned += ahead.yaw;
  }
  for (NearThing& thing : now.nearby) {
    const double before = thing.nearest.norm();
    thing.nearest = ahead.to_local(thing.nearest);
    thing.gap = std::max(std::min(thing.gap, 0.0), thing.gap + thing.nearest.norm() - before);
  }
  std::sort(now.nearby.begin(), now.nearby.end(),
            [](const NearThing& a, const NearThing& b) { return a.gap < b.gap; });
}

}  // namespace navvi_feedback::senses
