#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <set>

#include "devices/device_thread.hpp"
#include "drive/press_counter.hpp"
#include "navvi_feedback/drive/input_state.hpp"

struct SDL_Window;
union SDL_Event;

namespace navvi_feedback::devices {

/// The arrow keys as a stick, with Shift deflected by less than half, from a small window of its
/// own in the upper right corner of the screen: green while the keys drive, red while another
/// window has the focus. Then the device counts as lost. Until a first key it takes the focus by
/// itself. It hides while keys can be typed into another window of NavVI's. Who closes the window
/// presses F8. Keys come as events: none is too short, and one that is down when the focus comes
/// back counts only once it was released.
class Keyboard final : private ThreadedDevice {
 public:
  /// \throws DeviceError with a sentence if there is no display
  Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// axes: as Gamepad's first two. session: another with each return of the focus. buttons: in
  /// Gamepad's places: space, G, A, W; F8, H, enter and T at back, guide, start and the right
  /// shoulder; page up, page down and backspace at up, down and left; escape after all of them.
  [[nodiscard]] drive::InputState input() const;
  /// Hides the window for a second: keys can be typed elsewhere.
  void give_way() { gave_way_ = std::chrono::steady_clock::now(); }

 private:
  void open() override;
  [[nodiscard]] std::optional<drive::InputState> read() override;
  void close() override;

  void handle(const SDL_Event& event);
  void show(bool visible);
  void ask_for_focus();
  void paint();
  [[nodiscard]] drive::InputState state() const;

  // The thread's own.
  SDL_Window* window_ = nullptr;
  bool visible_ = true;
  bool focused_ = false;
  bool used_ = false;      ///< a key was pressed here
  std::set<int> down_;     ///< by SDL_Keycode
  std::set<int> ignored_;  ///< likewise: down since before the focus came
  unsigned session_ = 0;
  drive::PressCounter counter_;
  std::chrono::steady_clock::time_point asked_{};

  std::atomic<std::chrono::steady_clock::time_point> gave_way_{};

  DeviceThread thread_;  ///< the last, for it uses the window
};

}  // namespace navvi_feedback::devices
