#include "devices/input_source.hpp"

#include <cstdlib>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

constexpr double kTimeout = 0.25;  // s

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

}  // namespace

const char* to_string(InputSource::Kind kind) {
  switch (kind) {
    case InputSource::Kind::pad:
      return "pad";
    case InputSource::Kind::keyboard:
      return "keyboard";
    case InputSource::Kind::topic:
      break;
  }
  return "topic";
}

InputSource::InputSource(const std::string& wanted) {
  const bool automatic = wanted == "auto";
  if (wanted == "pad" || automatic) {
    try {
      pad_ = std::make_unique<Gamepad>();
    } catch (const DeviceError&) {
      if (!automatic) throw;
    }
    if (pad_ && (!automatic || pad_->status().connected)) {
      kind_ = Kind::pad;
      return;
    }
    pad_.reset();
  }
  if (wanted == "keyboard" || (automatic && has_display())) {
    try {
      keyboard_ = std::make_unique<Keyboard>();
      kind_ = Kind::keyboard;
    } catch (const DeviceError&) {
      if (!automatic) throw;
    }
  }
}

void InputSource::receive(const drive::InputState& input, double time) {
  received_ = input;
  received_at_ = time;
  if (keyboard_ && input.live) keyboard_->leave_focus();
}

drive::InputState InputSource::read(double time) const {
  if (pad_) return pad_->input();
  const bool fresh = received_at_ && time - *received_at_ <= kTimeout && received_.live;
  if (keyboard_) {
    const drive::InputState own = keyboard_->input();
    if (own.live || !fresh) return own;
  }
  return fresh ? received_ : drive::InputState{};
}

}  // namespace navvi_feedback::devices
