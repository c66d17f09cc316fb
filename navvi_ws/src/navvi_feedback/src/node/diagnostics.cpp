#include "node/diagnostics.hpp"

#include <cmath>
#include <navvi_files/printable.hpp>

namespace navvi_feedback::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;

DiagnosticStatus status(const char* name, std::int8_t level, const std::string& sentence) {
  DiagnosticStatus result;
  result.name = name;
  result.level = level;
  result.message = sentence;
  return result;
}

void add(DiagnosticStatus& to, const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = value;
  to.values.push_back(pair);
}

void add(DiagnosticStatus& to, const std::string& key, double value, int decimals) {
  add(to, key, navvi_files::fixed(value, decimals));
}

DiagnosticStatus own_pad(const devices::Gamepad::Status& pad) {
  if (!pad.connected)
    return status("navvi/pad", DiagnosticStatus::ERROR, "No game controller is connected.");
  if (pad.silent)
    return status("navvi/pad", DiagnosticStatus::ERROR,
                  "The game controller is connected, but its link is silent.");
  if (!pad.has_rumble)
    return status("navvi/pad", DiagnosticStatus::WARN, "This game controller has no rumble.");
  if (pad.jolting_firmware)
    return status("navvi/pad", DiagnosticStatus::WARN,
                  "The controller's firmware starts each rumble with a jolt; update it.");
  if (pad.rumble_errors > 0)
    return status("navvi/pad", DiagnosticStatus::WARN, "Some rumble commands were refused.");
  return status("navvi/pad", DiagnosticStatus::OK, "Connected.");
}

}  // namespace

DiagnosticStatus pad_status(const std::optional<devices::Gamepad::Status>& pad,
                            const std::string& input, bool live, bool felt) {
  DiagnosticStatus result;
  // Whether anything can be felt.
  std::string state = input == "keyboard" ? "off" : live ? "works" : "missing";
  if (pad) {
    result = own_pad(*pad);
    state = pad->felt() ? "works" : "missing";
    add(result, "name", pad->connected ? pad->name : "none");
    add(result, "firmware", pad->firmware == 0 ? "unknown" : std::to_string(pad->firmware));
    add(result, "heartbeat", pad->heartbeat ? "motion sensor" : "none");
    add(result, "other pads, ignored", std::to_string(pad->others));
    add(result, "rumble errors", std::to_string(pad->rumble_errors));
  } else if (live) {
    result = status("navvi/pad", DiagnosticStatus::OK, "The stick comes from the " + input + ".");
  } else {
    result = status("navvi/pad", DiagnosticStatus::ERROR, "Nothing comes from the " + input + ".");
  }
  if (!felt) state = "off";
  add(result, "input", input);
  add(result, "state", state);
  return result;
}

DiagnosticStatus audio_status(const devices::Mixer::Status& mixer) {
  using Device = devices::Mixer::Status::Device;
  const bool open = mixer.device == Device::open, off = mixer.device == Device::off;
  const std::string state = open ? "works" : off ? "off" : "missing";
  DiagnosticStatus result =
      status("navvi/audio",
             open  ? DiagnosticStatus::OK
             : off ? DiagnosticStatus::WARN
                   : DiagnosticStatus::ERROR,
             open                              ? "Open."
             : off                             ? "Sound is switched off."
             : mixer.device == Device::missing ? "There is no audio device."
                                               : "The audio device was lost.");
  if (!mixer.detail.empty()) result.message += " " + mixer.detail;
  add(result, "device", mixer.name.empty() ? "none" : mixer.name);
  add(result, "state", state);
  add(result, "hrtf", mixer.two_ears ? "on" : "off");
  return result;
}

DiagnosticStatus speech_status(const devices::Speaker::Status& speaker, const std::string& voice) {
  DiagnosticStatus result = status("navvi/speech", DiagnosticStatus::OK, "Ready.");
  if (!speaker.works)
    result = status("navvi/speech", DiagnosticStatus::ERROR, "The voice's process does not start.");
  else if (speaker.failed > 0)
    result = status("navvi/speech", DiagnosticStatus::WARN, "Some texts were not spoken.");
  else if (speaker.losses > 0)
    result = status("navvi/speech", DiagnosticStatus::WARN, "The voice's process was lost, and runs again.");
  add(result, "state", speaker.works ? "works" : "missing");
  add(result, "voice", voice);
  add(result, "spoken", std::to_string(speaker.spoken));
  add(result, "failed", std::to_string(speaker.failed));
  add(result, "losses", std::to_string(speaker.losses));
  return result;
}

DiagnosticStatus beat_status(const Beat& beat) {
  DiagnosticStatus result = beat.was_late()
                                ? status("navvi/beat", DiagnosticStatus::WARN,
                                         "The computer is too busy: signals come late.")
                                : status("navvi/beat", DiagnosticStatus::OK, "In time.");
  add(result, "longest_ms", std::to_string(std::lround(1e3 * beat.longest())));
  return result;
}

DiagnosticStatus latency_status(const devices::Latencies& latencies,
                                const std::optional<sounds::Learnt>& learnt) {
  DiagnosticStatus result = status("navvi/latency", DiagnosticStatus::OK, "In ms.");
  for (std::size_t i = 0; i < navvi_types::names(devices::Chain{}).size(); ++i) {
    const auto chain = static_cast<devices::Chain>(i);
    const devices::Latencies::Figures figures = latencies.figures(chain);
    if (figures.count == 0) continue;
    const std::string name = navvi_types::to_string(chain);
    add(result, name + "_p50_ms", figures.p50, 1);
    add(result, name + "_p99_ms", figures.p99, 1);
    add(result, name + "_max_ms", figures.longest, 1);
    add(result, name + "_count", std::to_string(figures.count));
  }
  if (learnt) {
    add(result, "stopping_delay_s", learnt->stopping_delay, 3);
    add(result, "stopping_spread_s", learnt->stopping_spread, 3);
    add(result, "turn_error_rad", learnt->turn_error, 3);
    add(result, "words_lead", learnt->words_lead ? "yes" : "no");
  }
  return result;
}

std::vector<Content> notices_of(const devices::Gamepad::Status& pad) {
  std::vector<Content> notices;
  if (pad.connected && !pad.has_rumble) notices.emplace_back(CueKind::notice, About::no_rumble);
  if (pad.connected && pad.has_rumble && pad.jolting_firmware)
    notices.emplace_back(CueKind::notice, About::pad_firmware);
  if (pad.others > 0) notices.emplace_back(CueKind::notice, About::second_pad);
  return notices;
}

}  // namespace navvi_feedback::node
