#pragma once

#include <memory>
#include <string>

#include "navvi_feedback/drive/input_state.hpp"
#include "process/child.hpp"

namespace navvi_feedback::devices {

/// The arrow keys as a stick, from the window of a process of its own (key_window). Where that ends,
/// as the display dies, the keys are lost; another is started every two seconds until one opens.
class Keyboard {
 public:
  /// \throws DeviceError with a sentence if there is no display
  Keyboard();

  /// axes: as Gamepad's first two. session: another with each return of the focus. buttons: in
  /// Gamepad's places: space, G, A, W; F8, H, enter and T at back, guide, start and the right
  /// shoulder; page up, page down and backspace at up, down and left; escape after all of them.
  /// Not live while another window has the focus, and if it was not read within the last 250 ms.
  [[nodiscard]] drive::InputState input();
  /// Hides the window for a second: keys can be typed elsewhere.
  void give_way();

 private:
  void start();
  void take(const process::Frame& frame);

  std::unique_ptr<process::Child> window_;
  process::Clock::time_point started_{};
  bool open_ = false;
  std::string failure_;  ///< a sentence of the window that did not open
  drive::InputState last_;
  unsigned first_session_ = 0;             ///< of this window
  process::Clock::time_point last_read_{};  ///< in that process
};

}  // namespace navvi_feedback::devices
