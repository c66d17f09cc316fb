#include "cues/bearing.hpp"

#include <cmath>

#include "cues/lead_off.hpp"

namespace navvi_feedback::cues {
namespace {

/// m/s and rad/s; a command below these is neutral.
constexpr Velocity kNeutral{0.02, 0.05};

bool beyond(double value, double limit) { return std::abs(value) > limit; }

Rounding rounding_of(const std::string& word) {
  return word == "floor" ? Rounding::floor : Rounding::nearest;
}

}  // namespace

Bearing::Bearing(const RouteConfig& config)
    : config_(config),
      rounding_(rounding_of(config.rounding)),
      steady_(rounding_, rounding_ == Rounding::floor ? 0.0 : config.kHysteresisDegrees * kDegree) {
}

void Bearing::observe(const Observation& now, bool halted, double time) {
  hour_ = steady_.update(now.guidance->steer_angle);
  const bool ahead = hour_ == 12 && rounding_ == Rounding::nearest;
  if (ahead) hour_ = lead_off(now, config_.kInTheWay, leads_off_ || halted);
  leads_off_ = ahead && hour_ != 12;
  if (beyond(now.commanded.linear, kNeutral.linear) ||
      beyond(now.commanded.angular, kNeutral.angular))
    last_commanded_ = time;
  const bool spot =
      now.measured && beyond(now.measured->angular, config_.kTurningRate) &&
      !beyond(now.measured->linear, config_.kSpotRadius * std::abs(now.measured->angular));
  if (spot) last_turning_ = time;
}

void Bearing::reset() {
  hour_.reset();
  steady_.reset();
}

bool Bearing::turns(double time) const {
  return last_turning_ && time - *last_turning_ < config_.kSettle;
}

}  // namespace navvi_feedback::cues
