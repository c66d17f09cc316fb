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

inline constexpr double kFoot = 0.3048;  ///< m

/// Metres: whole from 2 m on, halves below, never less than half a metre. Feet: whole below 20,
/// fives from there on.
/// \param metres  >= 0, finite; above 9999 of a unit it is no longer exact, so that the words are
///   bounded
/// \param units  "feet", else metres
[[nodiscard]] inline SpokenLength spoken_length(double metres, const std::string& units) {
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

inline constexpr std::size_t kMaxWord = 24;
inline constexpr std::size_t kMaxName = 40;      ///< of a place
inline constexpr std::size_t kMaxNameWord = 20;  ///< a phrase may put signs beside it

/// True if `text` may be spoken: UTF-8 of Latin, Greek or Cyrillic letters, digits and " ,.'-",
/// with at least one of the former, at most 80 bytes in all and 24 bytes a word.
[[nodiscard]] bool speakable(const std::string& text);

/// True if a place may be called `text`: words of letters and digits as in speakable(), of at most
/// 20 bytes, with one blank between two, at most 40 bytes in all.
[[nodiscard]] bool is_place_name(const std::string& text);

}  // namespace navvi_types
