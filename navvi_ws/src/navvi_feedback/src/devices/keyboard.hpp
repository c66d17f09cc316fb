#pragma once

#include <memory>

#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::devices {

/// The arrow keys as a stick, from a small window of its own. Without the focus the stick is
/// neutral; a closed window is a lost device.
class Keyboard {
 public:
  /// \throws DeviceError with a sentence if there is no display
  Keyboard();
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// axes: as Gamepad's first two, -1, 0 or 1. buttons: 0: space, 1: G.
  [[nodiscard]] drive::InputState input() const;

 private:
  class Window;
  std::unique_ptr<Window> window_;
};

}  // namespace navvi_feedback::devices
