#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace navvi_feedback::process {

/// Of the keyboard: Gamepad's buttons, and escape after them.
constexpr std::size_t kKeys = 16;

/// What key_window sends of its keys, as the bytes of a frame.
struct Keys {
  std::int64_t read = 0;       ///< ns of the steady clock, which all processes share
  bool focused = false;        ///< the window has the keys
  std::uint32_t session = 0;   ///< another with each return of the focus
  std::array<double, 2> axes;  ///< as Gamepad's first two
  std::array<bool, kKeys> buttons;
  std::array<std::uint32_t, kKeys> presses;  ///< how often each went down
};

}  // namespace navvi_feedback::process
