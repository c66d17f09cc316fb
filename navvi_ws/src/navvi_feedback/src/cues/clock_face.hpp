#pragma once

#include <navvi_types/angles.hpp>
#include <optional>

namespace navvi_feedback::cues {

/// Degrees of an hour, and of what an hour reaches to either side when rounded.
constexpr double kHourDegrees = 30.0;
constexpr double kDegree = navvi_types::radians(1.0);
constexpr double kHour = kHourDegrees * kDegree;  ///< rad

enum class Rounding {
  nearest,  ///< 12 is [-15, 15) degrees
  floor     ///< as the paper prints it: 12 is [0, 30) degrees
};

/// The hour of the clock face on which an angle lies (R-AUD-1).
/// \param angle  rad, clockwise from straight ahead, any number of turns
/// \return 1..12; nullopt if the angle is not finite
[[nodiscard]] std::optional<int> clock_hour(double angle, Rounding rounding);

/// The hour, held until the angle is clearly in another: an angle that trembles on a border gives
/// one hour.
class SteadyHour {
 public:
  /// \param hysteresis  rad, how far beyond its border the held hour still stands
  SteadyHour(Rounding rounding, double hysteresis) : rounding_(rounding), hysteresis_(hysteresis) {}

  /// nullopt, and nothing is held, if the angle is not finite.
  std::optional<int> update(double angle);
  void reset() { hour_.reset(); }

 private:
  Rounding rounding_;
  double hysteresis_;
  std::optional<int> hour_;
};

}  // namespace navvi_feedback::cues
