#include "cues/bearing.hpp"

#include <algorithm>
#include <cmath>

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

bool beyond(double value, double limit) { return std::abs(value) > limit; }

Rounding rounding_of(const std::string& word) {
  return word == "floor" ? Rounding::floor : Rounding::nearest;
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

Bearing::Bearing(const RouteConfig& config)
    : config_(config),
      rounding_(rounding_of(config.rounding)),
      steady_(rounding_, rounding_ == Rounding::floor ? 0.0 : config.kHysteresisDegrees * kDegree) {
}

void Bearing::observe(const Observation& now, bool halted, double time) {
  hour_ = steady_.update(now.guidance->steer_angle);
  const bool ahead = hour_ == 12 && rounding_ == Rounding::nearest;
  if (ahead) hour_ = lead_off(now, config_.kInTheWay, leads_off_ || halted);
  leads_off_ = ahead && hour_ != 12;
  if (beyond(now.commanded.linear, now.kNeutral.linear) ||
      beyond(now.commanded.angular, now.kNeutral.angular))
    last_commanded_ = time;
  const bool spot =
      now.measured && beyond(now.measured->angular, config_.kTurningRate) &&
      !beyond(now.measured->linear, config_.kSpotRadius * std::abs(now.measured->angular));
  if (spot) last_turning_ = time;
}

void Bearing::reset() {
  hour_.reset();
  steady_.reset();
}

bool Bearing::turns(double time) const {
  return last_turning_ && time - *last_turning_ < config_.kSettle;
}

}  // namespace navvi_feedback::cues
