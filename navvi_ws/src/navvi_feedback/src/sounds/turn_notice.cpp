#include "sounds/turn_notice.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::sounds {

std::optional<Play> TurnNotice::update(const Observation& now, bool leads, double volume,
                                       double time) {
  constexpr double kBefore = 2.5;      // s, to the corner
  constexpr double kLeast = 0.35;      // rad; a smaller turn is no news
  constexpr double kATick = 0.52;      // rad, 30 degrees
  constexpr int kMost = 6;             // ticks
  constexpr double kBeat = 0.16;       // s, from one tick to the next
  constexpr double kSameCorner = 1.0;  // m
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

}  // namespace navvi_feedback::sounds
