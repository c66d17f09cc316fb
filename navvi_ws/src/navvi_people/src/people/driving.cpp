#include "navvi_people/people/driving.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>

namespace navvi_people::people {

constexpr double kDegree = navvi_types::kPi / 180.0;
constexpr double kLeast = 22.5 * kDegree;   // below, nobody has measured; in proportion
constexpr double kSlight = 60.0 * kDegree;  // the border of the classes

constexpr double kEndStop = 0.99;
constexpr double kTremor = 0.3;  // s, over which the noise of a hand is alike

double Turning::made(double angle) {
  const double error = random_.normal() * config_.over_spread;
  if (!config_.faults) return angle;
  const double size = std::abs(angle);
  const double over = size < kSlight ? config_.over_slight : config_.over_ample;
  const double share = std::min(1.0, size / kLeast);
  return angle + std::copysign(kDegree * share * (over + error), angle);
}

double Turning::stop_delay() {
  const double delay = random_.lognormal(config_.stop_delay, config_.stop_spread);
  return config_.faults ? delay : 0.0;
}

Driving::Driving(const DrivingConfig& config, std::uint64_t person, std::uint64_t occasion)
    : config_(config), random_(occasion) {
  Random of_person(person);
  const double turn = of_person.normal();
  const double speed = of_person.normal();
  const bool left = of_person.chance(0.5);
  if (!config_.faults) return;
  turn_gain_ = 1.0 + std::clamp(config_.gain_error * turn, -0.3, 0.3);
  speed_gain_ = 1.0 + std::clamp(config_.gain_error * speed, -0.3, 0.3);
  bias_ = (left ? 1.0 : -1.0) * kDegree * config_.veer;
}

double Driving::shaped(double stick) const {
  const double beyond = (std::abs(stick) - config_.kDeadZone) / (1.0 - config_.kDeadZone);
  if (beyond <= 0.0) return 0.0;
  const double curved = (1.0 - config_.kExpo) * beyond + config_.kExpo * beyond * beyond * beyond;
  return std::copysign(curved, stick);
}

double Driving::stick_for(double wanted) const {
  if (wanted == 0.0) return 0.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (shaped(middle) < std::min(1.0, std::abs(wanted)) ? low : high) = middle;
  }
  return std::copysign(high, wanted);
}

double Driving::trembling(double stick, double dt) {
  const double keeps = std::exp(-dt / kTremor);
  tremor_ = keeps * tremor_ + std::sqrt(1.0 - keeps * keeps) * config_.noise * random_.normal();
  // At its end stop a stick is as steady as where it is let go.
  if (!config_.faults || stick == 0.0 || std::abs(stick) >= kEndStop) return stick;
  return std::clamp(stick + tremor_, -1.0, 1.0);
}

double Driving::veered(double driven) {
  const double error = random_.normal() * std::sqrt(std::abs(driven));
  if (!config_.faults) return 0.0;
  return bias_ * driven + kDegree * config_.veer_spread * error;
}

}  // namespace navvi_people::people
