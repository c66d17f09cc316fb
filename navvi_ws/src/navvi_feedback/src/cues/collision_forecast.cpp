#include "cues/collision_forecast.hpp"

#include <cmath>
#include <limits>

namespace navvi_feedback::cues {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kShort = 0.2;   // s; a velocity is not known from less
constexpr double kMemory = 0.4;  // s
constexpr double kJump = 0.3;    // m; another part of the thing is nearest now
constexpr double kBrush = 0.05;  // m; a thing that is missed by less is touched

}  // namespace

void CollisionForecast::update(const std::vector<NearThing>& nearby, double time) {
  std::map<std::uint32_t, std::vector<Seen>> seen;
  for (const NearThing& thing : nearby) {
    std::vector<Seen> track = std::move(seen_[thing.id]);
    if (!track.empty() && (track.back().second - thing.nearest).norm() > kJump) track.clear();
    // The same message may be looked at twice.
    if (track.empty() || track.back().second != thing.nearest)
      track.emplace_back(time, thing.nearest);
    while (time - track.front().first > kMemory && track.size() > 1) track.erase(track.begin());
    seen[thing.id] = std::move(track);
  }
  seen_ = std::move(seen);
}

double CollisionForecast::time_to_collision(const NearThing& thing) const {
  if (thing.gap <= 0.0) return 0.0;
  const auto seen = seen_.find(thing.id);
  if (seen == seen_.end()) return kNever;
  const auto& [first, from] = seen->second.front();
  const auto& [last, to] = seen->second.back();
  if (last - first < kShort) return kNever;
  const Eigen::Vector2d velocity = (to - from) / (last - first);
  const double speed2 = velocity.squaredNorm();
  const double closing = -thing.nearest.dot(velocity);
  if (closing <= 0.0 || speed2 < 1e-6) return kNever;
  // Where the point enters a circle as large as the robot on that side.
  const double radius = thing.nearest.norm() - thing.gap + kBrush;
  const double inside =
      closing * closing - speed2 * (thing.nearest.squaredNorm() - radius * radius);
  if (inside < 0.0) return kNever;
  return std::max(0.0, (closing - std::sqrt(inside)) / speed2);
}

}  // namespace navvi_feedback::cues
