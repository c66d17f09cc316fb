#pragma once

#include <optional>

#include "devices/device_thread.hpp"
#include "navvi_feedback/drive/input_state.hpp"

struct SDL_Window;

namespace navvi_feedback::devices {

/// The arrow keys as a stick, from a small window of its own. Without the focus the stick is
/// neutral; a closed window is a lost device.
class Keyboard final : private ThreadedDevice {
 public:
  /// \throws DeviceError with a sentence if there is no display
  Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// axes: as Gamepad's first two, -1, 0 or 1. buttons: 0: space, 1: G.
  [[nodiscard]] drive::InputState input() const;

 private:
  void open() override;
  /// nullopt once the window was closed.
  [[nodiscard]] std::optional<drive::InputState> read() override;
  void close() override;

  SDL_Window* window_ = nullptr;  ///< the thread's own
  DeviceThread thread_;           ///< the last, for it uses the window
};

}  // namespace navvi_feedback::devices
