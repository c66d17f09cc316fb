#include "sounds/soundscape.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::sounds {
namespace {

constexpr double kBefore = 2.5;     // s, to the corner
constexpr double kLeast = 0.35;     // rad; a smaller turn is no news
constexpr double kATick = 0.52;     // rad, 30 degrees
constexpr int kMost = 6;            // ticks
constexpr double kBeat = 0.16;      // s, from one tick to the next
constexpr double kSameCorner = 1.0; // m

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

std::optional<Play> TurnNotice::update(const Observation& now, bool leads, double volume,
                                       double time) {
  if (!leads || !now.guidance) {
    left_ = 0;
    return std::nullopt;
  }
  const Guidance& way = *now.guidance;
  const bool near = way.waypoint_distance < kBefore * now.motion().linear;
  const bool known = corner_ && (*corner_ - way.waypoint).norm() < kSameCorner;
  if (near && !known && !way.waypoint_is_goal && std::abs(way.turn_angle) >= kLeast) {
    corner_ = way.waypoint;
    left_ = std::clamp(static_cast<int>(std::lround(std::abs(way.turn_angle) / kATick)), 1, kMost);
    side_ = way.turn_angle > 0.0 ? -1.0 : 1.0;
  }
  if (left_ == 0 || time - last_ < kBeat) return std::nullopt;
  --left_;
  last_ = time;
  return Play{Earcon::turn, {0.0, side_}, volume};
}

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
