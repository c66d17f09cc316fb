#include "drive/assistance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_feedback::drive {

double fastest(double round_trip) {
  constexpr double kSeen = 1.0;      // m
  constexpr double kReaction = 0.6;  // s
  constexpr double kBrakes = 2.5;    // m/s^2
  if (round_trip <= 0.0) return std::numeric_limits<double>::infinity();
  // v * delay + v^2 / (2 brakes) = seen
  const double delay = round_trip + kReaction;
  return kBrakes * (std::sqrt(delay * delay + 2.0 * kSeen / kBrakes) - delay);
}

void AssistanceConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(mode, "mode", navvi_config::OneOf{{"off", "slow", "stop"}}, "",
        "before things in the way: leave the command as it is, slow it, or bring it to a stop");
  visit(least, "least", Range{0.05, 1.0}, "",
        "share of the command that slow leaves at least, and a stick that comes 0.3 s late");
}

double Assistance::share(const navvi_types::Velocity& wanted,
                         const std::vector<navvi_types::NearThing>& nearby, bool fresh) const {
  const double speed = std::abs(wanted.linear);
  if (config_.mode == "off" || speed == 0.0) return 1.0;
  if (!fresh) return config_.least;
  double allowed = speed;
  for (const navvi_types::NearThing& thing : nearby) {
    const bool in_the_way =
        thing.nearest.x() * wanted.linear > 0.0 && std::abs(thing.nearest.y()) <= config_.kHalfLane;
    if (!in_the_way) continue;
    const double room = std::max(0.0, thing.gap - config_.kMargin);
    allowed = std::min(allowed, std::sqrt(2.0 * config_.kDeceleration * room));
  }
  const double share = allowed / speed;
  return config_.mode == "slow" ? std::max(share, config_.least) : share;
}

}  // namespace navvi_feedback::drive
