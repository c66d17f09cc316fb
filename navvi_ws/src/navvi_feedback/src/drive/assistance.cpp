#include "drive/assistance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_feedback::drive {
namespace {

constexpr double kBrakes = 2.5;  // m/s^2
constexpr double kSeen = 1.0;  // m, free, at which a delay alone limits the speed

/// It is in the lane that the robot drives along.
bool is_ahead(const navvi_types::NearThing& thing, const navvi_types::Velocity& wanted) {
  constexpr double kHalfLane = 0.45;  // m
  return thing.nearest.x() * wanted.linear > 0.0 && std::abs(thing.nearest.y()) <= kHalfLane;
}

}  // namespace


double stopping_distance(double speed) { return speed * std::abs(speed) / (2.0 * kBrakes); }

double fastest(double round_trip, const navvi_types::Velocity& wanted,
               const std::vector<navvi_types::NearThing>& nearby) {
  constexpr double kReaction = 0.6;  // s
  constexpr double kKeeps = 0.1;     // m
  constexpr double kBeside = 0.1;    // share of the speed that is toward what is passed
  constexpr double kCreep = 0.05;    // m/s, that is left to get away
  if (round_trip <= 0.0) return std::numeric_limits<double>::infinity();
  // v * delay + v^2 / (2 brakes) = free
  const double delay = round_trip + kReaction;
  const auto toward_within = [&](double free) {
    return kBrakes * (std::sqrt(delay * delay + 2.0 * std::max(0.0, free) / kBrakes) - delay);
  };
  double most = toward_within(kSeen);
  for (const navvi_types::NearThing& thing : nearby) {
    const double toward = std::copysign(1.0, wanted.linear) * thing.nearest.normalized().x();
    if (toward > kBeside) most = std::min(most, toward_within(thing.gap - kKeeps) / toward);
  }
  return std::max(kCreep, most);
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
    if (!is_ahead(thing, wanted)) continue;
    const double room = std::max(0.0, thing.gap - config_.kMargin);
    allowed = std::min(allowed, std::sqrt(2.0 * config_.kDeceleration * room));
  }
  const double share = allowed / speed;
  return config_.mode == "slow" ? std::max(share, config_.least) : share;
}

}  // namespace navvi_feedback::drive
