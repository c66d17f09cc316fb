#include "sounds/soundscape.hpp"

#include <algorithm>

namespace navvi_feedback::sounds {
namespace {

/// s, between two pulses of what is at hand, and of what is `kFar` off (m) or more.
constexpr double kFast = 0.13;
constexpr double kSlow = 1.1;
constexpr double kFar = 10.0;
constexpr double kSonarRange = 3.0;  // m

bool due(std::optional<double>& last, double distance, double range, double time) {
  const double share = std::clamp(distance / range, 0.0, 1.0);
  if (last && time - *last < kFast + (kSlow - kFast) * share) return false;
  last = time;
  return true;
}

}  // namespace

std::vector<Play> Soundscape::update(const Input& now, double time) {
  std::vector<Play> plays;
  const auto turn =
      turn_.update(config_.turn.on ? now.off : std::nullopt, now.fine, now.motion, time);
  if (turn) plays.push_back(*turn);
  if (config_.beacon.on && now.waypoint && now.waypoint->norm() > config_.capture_radius &&
      due(beacon_, now.waypoint->norm(), kFar, time))
    plays.push_back({Earcon::beacon, *now.waypoint, config_.beacon.volume});
  if (config_.sonar.on && now.nearest && now.gap < kSonarRange &&
      due(sonar_, now.gap, kSonarRange, time))
    plays.push_back({Earcon::sonar, *now.nearest, config_.sonar.volume});
  return plays;
}

}  // namespace navvi_feedback::sounds
