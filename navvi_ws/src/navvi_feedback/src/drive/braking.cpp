#include "drive/braking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_feedback::drive {
namespace {

constexpr double kBrakes = 2.5;  // m/s^2
constexpr double kSeen = 1.0;  // m, free, at which a delay alone limits the speed

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

}  // namespace navvi_feedback::drive
