#pragma once

#include <memory>
#include <navvi_types/names.hpp>
#include <optional>
#include <string>

#include "devices/gamepad.hpp"
#include "drive/press_counter.hpp"
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

/// Where the stick comes from: our own pad or keyboard, or another driver's messages. The
/// keyboard's keys may also come as messages, from another window that they are typed into.
class InputSource {
 public:
  enum class Kind { pad, keyboard, topic };

  /// \param wanted  pad, keyboard, topic, or auto: the pad if there is one, otherwise the keyboard
  /// if there is a display, otherwise topic. What auto chose it keeps.
  /// \throws DeviceError if a device that was asked for by name cannot be used; a pad may come
  /// later
  explicit InputSource(const std::string& wanted);

  /// A message of another driver, or of another window, which says that it has lost the keys by one
  /// that is not live. Without effect if kind() is pad. \param time  s, of the clock that read() is
  /// given
  void receive(const drive::InputState& input, double time);
  /// Not live if the device is gone, or if the last message is older than 250 ms. A change from one
  /// window to another is another session.
  [[nodiscard]] drive::InputState read(double time);

  [[nodiscard]] Kind kind() const { return kind_; }
  /// nullptr unless kind() is pad.
  [[nodiscard]] Gamepad* pad() const { return pad_.get(); }

 private:
  Kind kind_ = Kind::topic;
  std::unique_ptr<Gamepad> pad_;
  std::unique_ptr<Keyboard> keyboard_;
  drive::PressCounter counter_;
  drive::InputState received_;
  unsigned session_ = 0;               ///< of what is received
  std::optional<double> received_at_;  ///< s
};

}  // namespace navvi_feedback::devices
