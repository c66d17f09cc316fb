#include "devices/voice.hpp"

#include <espeak-ng/speak_lib.h>

#include <algorithm>
#include <atomic>

#include "devices/device_error.hpp"

namespace navvi_feedback::devices {
namespace {

std::atomic<bool> in_use{false};

/// s; nothing that may be spoken takes as long.
constexpr int kLongest = 20;

struct Synthesis {
  Sound sound;
  const std::function<bool()>* cancelled = nullptr;
  bool aborted = false;
};

int on_samples(short* samples, int count, espeak_EVENT* events) {
  auto* synthesis = static_cast<Synthesis*>(events->user_data);
  if (synthesis == nullptr) return 0;
  auto& all = synthesis->sound.samples;
  if ((*synthesis->cancelled)() ||
      all.size() > static_cast<std::size_t>(synthesis->sound.rate) * kLongest) {
    synthesis->aborted = true;
    return 1;
  }
  if (samples != nullptr && count > 0) all.insert(all.end(), samples, samples + count);
  return 0;
}

/// A start and an end at zero, so that neither clicks.
void soften(Sound& sound) {
  auto& samples = sound.samples;
  const std::size_t ramp = std::min<std::size_t>(samples.size() / 2, 110);  // 5 ms
  for (std::size_t i = 0; i < ramp; ++i) {
    const auto scaled = [&](std::int16_t sample) {
      return static_cast<std::int16_t>(sample * static_cast<int>(i) / static_cast<int>(ramp));
    };
    samples[i] = scaled(samples[i]);
    samples[samples.size() - 1 - i] = scaled(samples[samples.size() - 1 - i]);
  }
}

/// Once in the life of the process: espeak_Terminate() can wait for ever for the library's own
/// thread when it follows soon on a start. \return samples a second, or a negative number
int initialize() {
  static const int sample_rate = [] {
    const int rate =
        espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr, espeakINITIALIZE_DONT_EXIT);
    if (rate > 0) espeak_SetSynthCallback(on_samples);
    return rate;
  }();
  return sample_rate;
}

}  // namespace

Voice::Voice(const std::string& name, int rate, int pitch) {
  if (in_use.exchange(true)) throw DeviceError("There is a speaker already in this process.");
  sample_rate_ = initialize();
  if (sample_rate_ <= 0) {
    in_use = false;
    throw DeviceError("espeak-ng could not be started; is the package espeak-ng-data installed?");
  }
  if (espeak_SetVoiceByName(name.empty() ? "en" : name.c_str()) != EE_OK ||
      espeak_SetParameter(espeakRATE, rate, 0) != EE_OK ||
      espeak_SetParameter(espeakPITCH, pitch, 0) != EE_OK) {
    in_use = false;
    throw DeviceError("espeak-ng has no voice \"" + name + "\" at " + std::to_string(rate) +
                      " words a minute and pitch " + std::to_string(pitch) + ".");
  }
}

Voice::~Voice() { in_use = false; }

void Voice::set_rate(int rate) { espeak_SetParameter(espeakRATE, rate, 0); }

Sound Voice::synthesize(const std::string& text, const std::function<bool()>& cancelled) {
  Synthesis synthesis;
  synthesis.sound.rate = sample_rate_;
  synthesis.cancelled = &cancelled;
  const espeak_ERROR error = espeak_Synth(text.c_str(), text.size() + 1, 0, POS_CHARACTER, 0,
                                          espeakCHARS_UTF8, nullptr, &synthesis);
  if (synthesis.aborted) espeak_Cancel();
  if (error != EE_OK || synthesis.aborted) synthesis.sound.samples.clear();
  soften(synthesis.sound);
  return std::move(synthesis.sound);
}

}  // namespace navvi_feedback::devices
