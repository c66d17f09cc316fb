#include "node/person_devices.hpp"

#include <algorithm>
#include <cctype>

#include "node/diagnostics.hpp"

namespace navvi_feedback::node {

using devices::InputSource;
using senses::Link;
using Sound = devices::Mixer::Status::Device;

PersonDevices::PersonDevices(const NodeConfig& config)
    : listener_(config.listener),
      speech_wanted_(config.speech),
      person_(config.person),
      mixer_(config.mixer, config.speech ? devices::Audio::on : devices::Audio::off),
      speech_(config.voice(), mixer_, latencies_),
      earcons_(mixer_),
      source_(config.input) {}

std::optional<devices::Gamepad::Status> PersonDevices::pad() const {
  return source_.pad() != nullptr ? std::optional(source_.pad()->status()) : std::nullopt;
}

/// A word in a person's file.
std::string PersonDevices::ears() const {
  const devices::Mixer::Status device = mixer_.status();
  if (by_topic() || device.device != Sound::open) return "";
  std::string name = device.name.empty() ? "device" : device.name;
  const auto odd = [](unsigned char c) { return std::isalnum(c) == 0; };
  std::replace_if(name.begin(), name.end(), odd, '_');
  return name;
}

bool PersonDevices::heard() const { return by_topic() || mixer_.status().device == Sound::open; }

bool PersonDevices::felt() const {
  const auto own = pad();
  return own ? own->felt() : source_.kind() == InputSource::Kind::topic;
}

senses::Devices PersonDevices::read(double time) {
  const auto own = pad();
  senses::Devices now;
  now.speaking = speech_.busy();  // before what became of it
  const devices::Speaker::Status voice = speech_.status();
  now.hands = source_.read(time);
  now.keyboard = source_.kind() == InputSource::Kind::keyboard;
  const Sound device = mixer_.status().device;
  now.audio = !voice.works || device == Sound::lost ? Link::lost
              : device == Sound::missing            ? Link::never
                                                    : Link::alive;
  now.ears = ears();
  now.words = speech_wanted_ || by_topic();
  now.sounds = heard();
  now.voice = by_topic() || voice.works;
  now.heard = by_topic() || voice.heard;
  now.motors = !own || own->answers();
  now.felt = felt();
  now.pad = own ? own->guid : "joy";
  if (own) now.states = notices_of(*own);
  now.person = person_;
  return now;
}

void PersonDevices::use(int rate, double volume) {
  speech_.set_rate(rate);
  mixer_.set_volume(volume);
}

std::vector<sounds::Play> PersonDevices::obey(const core::Output& told) {
  std::vector<sounds::Play> played = earcons_.play(told.plays);
  if (by_topic()) played = told.plays;
  (void)earcons_.hold(told.flow, told.flow_gain);
  for (const sounds::Play& sound : speech_.take_played())
    if (heard()) played.push_back(sound);
  speech_.obey(told.voice, told.answers);
  return played;
}

bool PersonDevices::move_motors(const haptics::Rumble& rumble,
                                const std::function<void()>& called) {
  if (source_.pad() != nullptr) source_.pad()->rumble(rumble, called);
  return source_.pad() != nullptr;
}

}  // namespace navvi_feedback::node
