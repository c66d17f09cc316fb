#include "drive/drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_feedback::drive {

using navvi_types::kBrakes;
constexpr double kSeen = 1.0;  // m, free, at which a delay alone limits the speed

void DriveConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(stick, "stick", navvi_config::OneOf{{"left", "right"}}, "", "which stick drives");
  visit(enable, "enable", Range{-1, 255}, "",
        "index of a button without which nothing drives; -1: none");
  visit(dead_zone, "dead_zone", Range{0.02, 0.5}, "",
        "deflection of the stick that counts as neutral");
  visit(expo, "expo", Range{0.0, 1.0}, "", "0: linear; 1: cubic, finer near the centre");
  visit(max_forward, "max_forward", Range{0.1, 1.5}, "m/s", "speed at full stick forward");
  visit(max_reverse, "max_reverse", Range{0.0, 1.5}, "m/s", "speed at full stick back");
  visit(max_turn, "max_turn", Range{0.1, 2.5}, "rad/s",
        "turning speed at full stick left or right");
}

Stick Drive::shaped(const Stick& stick) const {
  const double x = std::clamp(stick.x, -1.0, 1.0);
  const double y = std::clamp(stick.y, -1.0, 1.0);
  const auto axis = [this](double value) {
    const double beyond = (std::abs(value) - config_.dead_zone) / (1.0 - config_.dead_zone);
    if (beyond <= 0.0) return 0.0;
    const double curved = (1.0 - config_.expo) * beyond + config_.expo * beyond * beyond * beyond;
    return std::copysign(curved, value);
  };
  return {axis(x), axis(y)};
}

void Drive::disarm() {
  velocity_ = {};
  neutral_for_ = 0.0;
  armed_ = false;
}

std::optional<Velocity> Drive::update(const std::optional<Stick>& stick, double dt) {
  if (!stick || !std::isfinite(stick->x) || !std::isfinite(stick->y)) {
    disarm();
    return std::nullopt;
  }
  const Stick wanted = shaped(*stick);
  if (!armed_) {
    const bool neutral = wanted.x == 0.0 && wanted.y == 0.0;
    neutral_for_ = neutral ? neutral_for_ + dt : 0.0;
    armed_ = neutral_for_ >= config_.kArmHold;
    return Velocity{};
  }
  const double linear = wanted.y * (wanted.y > 0.0 ? config_.max_forward : config_.max_reverse);
  velocity_.linear = navvi_types::approach(velocity_.linear, linear, config_.acceleration * dt,
                                           config_.deceleration * dt);
  const double turn = config_.turn_acceleration * dt;
  velocity_.angular =
      navvi_types::approach(velocity_.angular, wanted.x * config_.max_turn, turn, turn);
  return velocity_;
}

double stopping_distance(double speed) { return speed * std::abs(speed) / (2.0 * kBrakes); }

double fastest(double round_trip, const Velocity& wanted, const std::vector<NearThing>& nearby) {
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
  for (const NearThing& thing : nearby) {
    const double toward = std::copysign(1.0, wanted.linear) * thing.nearest.normalized().x();
    if (toward > kBeside) most = std::min(most, toward_within(thing.gap - kKeeps) / toward);
  }
  return std::max(kCreep, most);
}

}  // namespace navvi_feedback::drive
