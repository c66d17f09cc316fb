#include "cues/collision_forecast.hpp"

#include <cmath>
#include <limits>

namespace navvi_feedback::cues {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kShort = 0.2;    // s; a velocity is not known from less
constexpr double kMemory = 0.4;   // s
constexpr double kJump = 0.3;     // m; another part of the thing is nearest now
constexpr double kBrush = 0.05;   // m; a thing that is missed by less is touched
constexpr double kCreeps = 0.01;  // m/s; how a slower robot nears a thing is not known
constexpr double kPause = 0.5;    // s without an update; what was driven meanwhile is not known

/// s, until a point enters a circle as large as the robot on that side.
double until(const NearThing& thing, const Eigen::Vector2d& velocity) {
  const double speed2 = velocity.squaredNorm();
  const double closing = -thing.nearest.dot(velocity);
  if (closing <= 0.0 || speed2 < 1e-6) return kNever;
  const double radius = thing.nearest.norm() - thing.gap + kBrush;
  const double inside =
      closing * closing - speed2 * (thing.nearest.squaredNorm() - radius * radius);
  if (inside < 0.0) return kNever;
  return std::max(0.0, (closing - std::sqrt(inside)) / speed2);
}

}  // namespace

void CollisionForecast::update(const std::vector<NearThing>& nearby, double drives, double time) {
  if (time - time_ < kPause) driven_ += std::abs(drives) * (time - time_);
  time_ = time;
  std::map<std::uint32_t, std::vector<Seen>> seen;
  for (const NearThing& thing : nearby) {
    std::vector<Seen> track = std::move(seen_[thing.id]);
    if (!track.empty() && (track.back().point - thing.nearest).norm() > kJump) track.clear();
    // The same message may be looked at twice.
    if (track.empty() || track.back().point != thing.nearest)
      track.push_back({time, driven_, thing.nearest});
    while (time - track.front().time > kMemory && track.size() > 1) track.erase(track.begin());
    seen[thing.id] = std::move(track);
  }
  seen_ = std::move(seen);
}

std::optional<CollisionForecast::Motion> CollisionForecast::motion_of(
    const NearThing& thing) const {
  const auto seen = seen_.find(thing.id);
  if (seen == seen_.end()) return std::nullopt;
  const Seen& first = seen->second.front();
  const Seen& last = seen->second.back();
  const double passed = last.time - first.time;
  if (passed < kShort) return std::nullopt;
  return Motion{(last.point - first.point) / passed, (last.driven - first.driven) / passed};
}

double CollisionForecast::time_to_collision(const NearThing& thing, const Velocity& drives) const {
  if (thing.gap <= 0.0) return 0.0;
  const auto motion = motion_of(thing);
  double left = motion ? until(thing, motion->velocity) : kNever;
  if (thing.moving) return left;
  const double speed = std::abs(drives.linear);
  if (motion && motion->drives > kCreeps && motion->drives < speed) left *= motion->drives / speed;
  // As its point, seen from the robot, moves at this instant.
  const Eigen::Vector2d& point = thing.nearest;
  const Eigen::Vector2d turned = drives.angular * Eigen::Vector2d(point.y(), -point.x());
  return std::min(left, until(thing, turned - Eigen::Vector2d(drives.linear, 0.0)));
}

double CollisionForecast::time_once_driven(const NearThing& thing,
                                           const Eigen::Vector2d& velocity) const {
  if (thing.gap <= 0.0) return 0.0;
  const auto motion = motion_of(thing);
  return motion ? until(thing, motion->velocity - velocity) : kNever;
}

}  // namespace navvi_feedback::cues
