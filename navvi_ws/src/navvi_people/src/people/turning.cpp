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
  using navvi_config::Range;
  visit(faults, "faults", navvi_config::Any{}, "", "false: turns are as long as they should be");
  visit(over_slight, "over_slight", Range{-45.0, 90.0}, "deg",
        "turned too far by words, turns of 22.5 to 60 deg, the mean");
  visit(over_ample, "over_ample", Range{-45.0, 90.0}, "deg", "likewise, turns of 60 deg and more");
  visit(over_spread, "over_spread", Range{0.0, 45.0}, "deg", "standard deviation, turn by turn");
  visit(stop_delay, "stop_delay", Range{0.0, 2.0}, "s",
        "from the decision to stop a turn to the hand, the median");
  visit(stop_spread, "stop_spread", Range{0.0, 1.0}, "", "standard deviation of its logarithm");
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
