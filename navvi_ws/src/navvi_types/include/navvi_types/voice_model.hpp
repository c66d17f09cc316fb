#pragma once

#include <cstddef>

namespace navvi_types {

/// s: when a voice of usual pace, that begins a text at a time, has spoken it. Where there is no
/// device, as in sessions without ROS.
[[nodiscard]] constexpr double spoken_at(double begun, std::size_t characters) {
  constexpr double kStarts = 0.15;  // s
  constexpr double kCharactersPerSecond = 18.0;
  return begun + kStarts + static_cast<double>(characters) / kCharactersPerSecond;
}

}  // namespace navvi_types
