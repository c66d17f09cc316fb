#include "cues/lead_off.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cues/clock_face.hpp"
#include "cues/side.hpp"

namespace navvi_feedback::cues {
namespace {

/// rad; after a smaller turn is announced, a person turns too far.
constexpr double kWorthSaying = 7.0 * kDegree;
/// m; a thing so near is steered away from, wherever the path leads.
constexpr double kTouching = 0.1;
/// m; a thing beside the robot and farther off is out of reach.
constexpr double kBeside = 0.5;
/// m, by which a thing that was in the way may be farther off before it no longer is.
constexpr double kKept = 0.1;

/// The hour away from a thing beside the robot that is all but touched.
std::optional<int> away_from_touched(const Observation& now, bool held) {
  const double touched = held ? 2.0 * kTouching : kTouching;
  for (const NearThing& thing : now.nearby) {
    const Side side = side_of(thing.nearest);
    if (thing.gap > touched || side == Side::ahead || side == Side::behind) continue;
    const double away = side == Side::left ? 1.0 : -1.0;
    const bool room = std::none_of(now.nearby.begin(), now.nearby.end(), [&](const auto& other) {
      return away * other.nearest.y() < 0.0 && other.gap < 2.0 * touched;
    });
    if (room && away * now.guidance->steer_angle > -kWorthSaying) return away > 0.0 ? 1 : 11;
  }
  return std::nullopt;
}

}  // namespace

int lead_off(const Observation& now, double in_the_way, bool held) {
  if (const auto hour = away_from_touched(now, held)) return *hour;
  const double angle = now.guidance->steer_angle;
  if (std::abs(angle) < (held ? 0.5 : 1.0) * kWorthSaying) return 12;
  const double side = angle > 0.0 ? 1.0 : -1.0;
  const double kept = held ? kKept : 0.0;
  const double ahead = std::min(in_the_way, now.guidance->waypoint_distance);
  bool leads_off = false;
  for (const NearThing& thing : now.nearby) {
    if (thing.nearest.x() <= 0.0) continue;
    const double beyond = side * (-std::atan2(thing.nearest.y(), thing.nearest.x()) - angle);
    if (thing.gap < ahead && beyond > 0.0 && beyond < kHour) return 12;
    const bool before = thing.gap < ahead + kept && std::abs(thing.nearest.y()) < kHalfLane + kept;
    const bool left_behind = thing.gap < kBeside + kept && side * thing.nearest.y() > 0.0;
    leads_off = leads_off || before || left_behind;
  }
  if (!leads_off) return 12;
  return angle > 0.0 ? 1 : 11;
}

}  // namespace navvi_feedback::cues
