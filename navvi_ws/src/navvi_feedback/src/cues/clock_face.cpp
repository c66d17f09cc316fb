#include "cues/clock_face.hpp"

#include <cmath>

namespace navvi_feedback::cues {
namespace {

/// In [0, 360). \param angle  rad, finite
double degrees_round(double angle) {
  const double degrees = std::fmod(angle / kDegree, 360.0);
  const double positive = degrees < 0.0 ? degrees + 360.0 : degrees;
  return positive < 360.0 ? positive : 0.0;
}

}  // namespace

std::optional<int> clock_hour(double angle, Rounding rounding) {
  if (!std::isfinite(angle)) return std::nullopt;
  const double shift = rounding == Rounding::nearest ? kHourDegrees / 2.0 : 0.0;
  const int hour = static_cast<int>(std::floor((degrees_round(angle) + shift) / kHourDegrees)) % 12;
  return hour == 0 ? 12 : hour;
}

std::optional<int> SteadyHour::update(double angle) {
  const std::optional<int> hour = clock_hour(angle, rounding_);
  if (hour && hour_) {
    const double beyond = rounding_ == Rounding::floor ? kHourDegrees / 2.0 : 0.0;
    const double centre = *hour_ * kHourDegrees + beyond;
    const double off = std::remainder(degrees_round(angle) - centre, 360.0);
    if (std::abs(off) <= kHourDegrees / 2.0 + hysteresis_ / kDegree) return hour_;
  }
  hour_ = hour;
  return hour_;
}

}  // namespace navvi_feedback::cues
