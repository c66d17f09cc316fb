#pragma once

#include <cmath>

namespace navvi_types {

inline constexpr double kPi = 3.14159265358979323846;

[[nodiscard]] constexpr double radians(double degrees) { return degrees * kPi / 180.0; }
[[nodiscard]] constexpr double degrees(double radians) { return radians * 180.0 / kPi; }
/// The same direction in [-pi, pi].
[[nodiscard]] inline double wrap(double angle) { return std::remainder(angle, 2.0 * kPi); }

}  // namespace navvi_types
