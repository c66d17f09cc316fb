#include "navvi_people/people/turning.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kLeast = 22.5 * kDegree;   // below, nobody has measured; in proportion
constexpr double kSlight = 60.0 * kDegree;  // the border of the classes

}  // namespace

void TurningConfig::describe(navvi_config::Visitor& visit) {
  visit(faults, "faults", navvi_config::Any{}, "", "false: turns are as long as they should be");
}

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

}  // namespace navvi_people::people
