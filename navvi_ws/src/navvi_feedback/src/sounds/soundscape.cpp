#include "sounds/soundscape.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::sounds {
namespace {

/// s, between two pulses of what is at hand, and of what is `kFar` off (m) or more.
constexpr double kFast = 0.13;
constexpr double kSlow = 1.1;
constexpr double kFar = 10.0;

bool due(std::optional<double>& last, double distance, double time) {
  const double share = std::clamp(distance / kFar, 0.0, 1.0);
  if (last && time - *last < kFast + (kSlow - kFast) * share) return false;
  last = time;
  return true;
}

/// m, in base_link: where to go next.
std::optional<Eigen::Vector2d> waypoint(const Observation& now, const Soundscape::Steering& lead) {
  if (!lead.off || !now.guidance || now.guidance->waypoint_distance <= 0.0) return std::nullopt;
  const double angle = now.guidance->waypoint_angle + now.turned;
  return now.guidance->waypoint_distance * Eigen::Vector2d(std::cos(angle), -std::sin(angle));
}

}  // namespace

std::vector<Play> Soundscape::update(const Observation& now, const Steering& lead, double time) {
  std::vector<Play> plays;
  const auto turn = turn_.update(now.lead == Lead::ticks ? lead.off : std::nullopt, lead.fine,
                                 lead.motion, time);
  if (turn) plays.push_back(*turn);
  const bool lasts = now.lead == Lead::flow && lead.off;
  if (const auto tick = notice_.update(now, lasts, config_.turn.volume, time))
    plays.push_back(*tick);
  const auto next = waypoint(now, lead);
  if (config_.beacon.on && next && next->norm() > config_.kCaptureRadius &&
      due(beacon_, next->norm(), time))
    plays.push_back({Earcon::beacon, *next, config_.beacon.volume});
  return plays;
}

}  // namespace navvi_feedback::sounds
