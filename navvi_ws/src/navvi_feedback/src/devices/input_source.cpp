#include "devices/input_source.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include "devices/device_error.hpp"
#include "process/keys.hpp"

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;
using process::Clock;

constexpr auto kOpens = 10s;  ///< that a busy machine needs for a window at most
constexpr auto kAgain = 2s;   ///< between two attempts to open a window

constexpr double kTimeout = 0.25;  // s
constexpr double kLost = 1.0;      // s

/// What was read last, and how long ago: a busy computer delays it, and has not lost it.
drive::InputState aged(const drive::InputState& last, double age) {
  if (age <= kTimeout) return last;
  drive::InputState silent;
  silent.late = last.live && age <= kLost;
  return silent;
}

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

}  // namespace

Keyboard::Keyboard() {
  start();
  if (const auto first = window_->receive(Clock::now() + kOpens)) take(*first);
  if (!open_)
    throw DeviceError(failure_.empty() ? "The program key_window does not start; build NavVI again."
                                       : failure_);
}

void Keyboard::start() {
  window_ = std::make_unique<process::Child>("key_window", std::vector<std::string>{});
  started_ = Clock::now();
  open_ = false;
  first_session_ = last_.session + 1;
}

void Keyboard::take(const process::Frame& frame) {
  open_ = frame.value == 1;
  if (!open_) failure_ = frame.bytes;
  process::Keys keys{};
  if (frame.bytes.size() != sizeof keys) return;
  std::memcpy(&keys, frame.bytes.data(), sizeof keys);
  last_.live = keys.focused;
  last_.session = first_session_ + keys.session;
  last_.axes.assign(keys.axes.begin(), keys.axes.end());
  last_.buttons.assign(keys.buttons.begin(), keys.buttons.end());
  last_.presses.assign(keys.presses.begin(), keys.presses.end());
  last_read_ = Clock::time_point(Clock::duration(keys.read));
}

drive::InputState Keyboard::input() {
  while (const auto frame = window_->receive({})) take(*frame);
  const auto now = Clock::now();
  if (window_->gone()) open_ = false;
  if ((window_->gone() && now - started_ >= kAgain) || now - std::max(started_, last_read_) > kOpens)
    start();
  const std::chrono::duration<double> age = now - last_read_;
  return open_ ? aged(last_, age.count()) : drive::InputState{};
}

void Keyboard::give_way() {
  // The window reads it within its period; one that hangs needs none.
  if (open_) static_cast<void>(window_->send(0, ""));
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
  drive::InputState now = received_at_ ? aged(received_, time - *received_at_) : received_;
  now.session = 2 * now.session;
  if (!keyboard_) return now;
  drive::InputState own = keyboard_->input();
  own.session = 2 * own.session + 1;
  return own.live || !(now.live || now.late) ? own : now;
}

}  // namespace navvi_feedback::devices
