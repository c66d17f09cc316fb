#include "devices/keyboard.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>

#include "devices/device_error.hpp"
#include "process/keys.hpp"

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;
using process::Clock;

constexpr auto kOpens = 10s;  ///< that a busy machine needs for a window at most
constexpr auto kFrozen = 250ms;
constexpr auto kAgain = 2s;  ///< between two attempts to open a window

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
  return open_ && now - last_read_ <= kFrozen ? last_ : drive::InputState{};
}

void Keyboard::give_way() {
  // The window reads it within its period; one that hangs needs none.
  if (open_) static_cast<void>(window_->send(0, ""));
}

}  // namespace navvi_feedback::devices
