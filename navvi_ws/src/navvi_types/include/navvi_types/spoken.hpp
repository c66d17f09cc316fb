#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace navvi_types {

/// A length as people say and read it.
struct SpokenLength {
  std::string number;  ///< with one decimal, if it has any
  const char* unit;    ///< meter, meters, foot or feet: a key of `words` in config/phrases/
};

/// Metres: whole from 2 m on, halves below, never less than half a metre. Feet: whole below 20,
/// fives from there on.
/// \param metres  >= 0, finite; above 9999 of a unit it is no longer exact, so that the words are
///   bounded
/// \param units  "feet", else metres
[[nodiscard]] inline SpokenLength spoken_length(double metres, const std::string& units) {
  constexpr double kFoot = 0.3048;  // m
  constexpr double kFar = 9999.0;
  const bool feet = units == "feet";
  const double length = feet ? metres / kFoot : metres;
  double rounded = std::round(length);
  if (feet) rounded = length < 20.0 ? std::max(1.0, rounded) : 5.0 * std::round(length / 5.0);
  if (!feet && length < 1.75) rounded = std::max(0.5, std::round(length * 2.0) / 2.0);
  char number[16];
  std::snprintf(number, sizeof number, rounded == std::floor(rounded) ? "%.0f" : "%.1f",
                std::min(rounded, kFar));
  if (feet) return {number, rounded == 1.0 ? "foot" : "feet"};
  return {number, rounded == 1.0 ? "meter" : "meters"};
}

/// s: when a voice of usual pace, that begins a text at a time, has spoken it. Where there is no
/// device, as in sessions without ROS.
[[nodiscard]] constexpr double spoken_at(double begun, std::size_t characters) {
  constexpr double kStarts = 0.15;  // s
  constexpr double kCharactersPerSecond = 18.0;
  return begun + kStarts + static_cast<double>(characters) / kCharactersPerSecond;
}

}  // namespace navvi_types
