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
  const bool went_on = received_.live && received_at_ && time - *received_at_ <= kTimeout;
  if (input.live && !went_on) ++session_;
  drive::InputState next = input;
  next.session = session_;
  received_ = counter_.count(next);
  received_at_ = time;
  if (keyboard_) keyboard_->give_way();
}

drive::InputState InputSource::read(double time) {
  if (pad_) return pad_->input();
  const bool fresh = received_at_ && time - *received_at_ <= kTimeout && received_.live;
  drive::InputState now = fresh ? received_ : drive::InputState{};
  now.session = 2 * now.session;
  if (!keyboard_) return now;
  drive::InputState own = keyboard_->input();
  own.session = 2 * own.session + 1;
  return own.live || !fresh ? own : now;
}

}  // namespace navvi_feedback::devices
