#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "devices/device_thread.hpp"
#include "navvi_feedback/drive/input_state.hpp"

struct SDL_Window;

namespace navvi_feedback::devices {

/// The arrow keys as a stick, with Shift deflected by less than half, from a small window of its
/// own: green while the keys drive, red while another window has the focus. Then the device counts
/// as lost. Until a first key it takes the focus by itself. Who closes the window presses escape.
class Keyboard final : private ThreadedDevice {
 public:
  /// \throws DeviceError with a sentence if there is no display
  Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// axes: as Gamepad's first two. session: another with each return of the focus. buttons: in
  /// Gamepad's places: space, G, A, W; escape, H, enter and T at back,
  /// guide, start and the right shoulder; page up, page down and
  /// backspace at up, down and left.
  [[nodiscard]] drive::InputState input() const;
  /// Takes the focus by itself no more: keys are typed elsewhere.
  void leave_focus() { used_ = true; }

 private:
  void open() override;
  [[nodiscard]] std::optional<drive::InputState> read() override;
  void close() override;

  void ask_for_focus();
  void paint(bool focused);

  // The thread's own.
  SDL_Window* window_ = nullptr;
  bool focused_ = false;
  std::atomic<bool> used_{false};  ///< a key was pressed, here or elsewhere
  std::chrono::steady_clock::time_point closed_{};
  unsigned session_ = 0;
  std::chrono::steady_clock::time_point asked_{};

  DeviceThread thread_;  ///< the last, for it uses the window
};

}  // namespace navvi_feedback::devices
