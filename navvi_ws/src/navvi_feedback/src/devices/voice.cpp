#include "devices/voice.hpp"

#include <chrono>
#include <cstring>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;
using process::Clock;

constexpr auto kStart = 5s;  ///< that a busy machine needs to load the library at most
constexpr auto kHangs = 1s;  ///< a sentence is synthesized in some ms

Sound sound_of(const process::Frame& frame) {
  Sound sound;
  if (frame.value <= 0) return sound;
  sound.rate = frame.value;
  sound.samples.resize(frame.bytes.size() / sizeof(std::int16_t));
  if (!sound.samples.empty())
    std::memcpy(sound.samples.data(), frame.bytes.data(), 2 * sound.samples.size());
  return sound;
}

}  // namespace

Voice::Voice(const std::string& name, int pitch)
    : arguments_{name.empty() ? "en" : name, std::to_string(pitch)} {
  if (const std::string failure = start(); !failure.empty()) throw DeviceError(failure);
}

std::string Voice::start() {
  child_ = std::make_unique<process::Child>("espeak_voice", arguments_);
  const auto first = child_->receive(Clock::now() + kStart);
  if (first && first->value > 0) return "";
  child_.reset();
  return first ? first->bytes : "The program espeak_voice does not start; build NavVI again.";
}

std::optional<Sound> Voice::begin(const std::string& text, int rate) {
  if (!child_ && !start().empty()) return std::nullopt;
  if (!child_->send(rate, text) || (rest_due_ && !rest())) {
    replace();
    return std::nullopt;
  }
  rest_due_ = true;
  return receive();
}

std::optional<Sound> Voice::rest() {
  rest_due_ = false;
  return receive();
}

std::optional<Sound> Voice::receive() {
  if (child_)
    if (const auto answer = child_->receive(Clock::now() + kHangs)) return sound_of(*answer);
  replace();
  return std::nullopt;
}

void Voice::tend() {
  if (child_ && child_->gone()) replace();
}

void Voice::replace() {
  rest_due_ = false;
  ++losses_;
  static_cast<void>(start());
}

}  // namespace navvi_feedback::devices
