#include "senses/foresight.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::senses {
namespace {

constexpr double kLongest = 5.0;  // s, of a round trip

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

void Foresight::look_ahead(Observation& now, double over, double time) const {
  const Velocity then = at(time - over), last = at(time);
  if (now.measured) {
    now.measured->linear += last.linear - then.linear;
    now.measured->angular += last.angular - then.angular;
  }
  const navvi_types::Pose2 ahead = moved(over, time);
  now.turned += ahead.yaw;
  for (NearThing& thing : now.nearby) {
    const double before = thing.nearest.norm();
    thing.nearest = ahead.to_local(thing.nearest);
    thing.gap = std::max(std::min(thing.gap, 0.0), thing.gap + thing.nearest.norm() - before);
  }
  std::sort(now.nearby.begin(), now.nearby.end(),
            [](const NearThing& a, const NearThing& b) { return a.gap < b.gap; });
}

}  // namespace navvi_feedback::senses
