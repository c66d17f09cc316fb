#pragma once

#include <memory>
#include <optional>
#include <string>

#include "devices/gamepad.hpp"
#include "devices/keyboard.hpp"
#include "drive/press_counter.hpp"
#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::devices {

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

[[nodiscard]] const char* to_string(InputSource::Kind kind);

}  // namespace navvi_feedback::devices
