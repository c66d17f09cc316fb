// The program of the voice: sentences in, samples out. espeak-ng may crash or hang, and ends only
// this process then. The first frame that it sends, and each answer, has the samples' rate in Hz
// as its value and the samples, of 16 bits each, as its bytes; or 0 and a sentence on what failed.
// A request has the words a minute as its value and the text as its bytes.
// Usage: espeak_voice VOICE PITCH

#include <espeak-ng/speak_lib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "process/frame.hpp"

namespace navvi_feedback::process {
namespace {

using Samples = std::vector<short>;

/// s; nothing that may be spoken takes as long.
constexpr int kLongest = 20;
constexpr std::size_t kRamp = 110;  // samples, 5 ms

std::size_t g_most = 0;  ///< samples of one sentence

int on_samples(short* samples, int count, espeak_EVENT* events) {
  auto* all = static_cast<Samples*>(events->user_data);
  if (all == nullptr) return 0;
  if (all->size() > g_most) {
    all->clear();
    return 1;
  }
  if (samples != nullptr && count > 0) all->insert(all->end(), samples, samples + count);
  return 0;
}

/// A start and an end at zero, so that neither clicks.
void soften(Samples& samples) {
  const std::size_t ramp = std::min(samples.size() / 2, kRamp);
  for (std::size_t i = 0; i < ramp; ++i) {
    const auto scaled = [&](short sample) {
      return static_cast<short>(sample * static_cast<int>(i) / static_cast<int>(ramp));
    };
    samples[i] = scaled(samples[i]);
    samples[samples.size() - 1 - i] = scaled(samples[samples.size() - 1 - i]);
  }
}

/// espeak-ng up to 1.52 (MatchRule in dictionary.c) reads on beyond a word of some languages up to
/// the next space, over the stack above: it finds one here, and does not run off the stack.
[[gnu::noinline]] espeak_ERROR synthesize_below_spaces(const std::string& text, Samples& samples) {
  std::array<char, 4096> spaces;
  spaces.fill(' ');
  asm volatile("" : : "r"(spaces.data()) : "memory");
  const espeak_ERROR error = espeak_Synth(text.c_str(), text.size() + 1, 0, POS_CHARACTER, 0,
                                          espeakCHARS_UTF8, nullptr, &samples);
  asm volatile("" : : "r"(spaces.data()) : "memory");
  return error;
}

int run(const std::string& voice, const std::string& pitch) {
  const int socket = socket_of_parent();
  const int sample_rate =
      espeak_Initialize(AUDIO_OUTPUT_SYNCHRONOUS, 0, nullptr, espeakINITIALIZE_DONT_EXIT);
  std::string failure;
  if (sample_rate <= 0)
    failure = "espeak-ng does not start; install the package espeak-ng-data.";
  else if (espeak_SetVoiceByName(voice.c_str()) != EE_OK)
    failure = "espeak-ng has no voice \"" + voice + "\"; \"espeak-ng --voices\" lists them.";
  else if (espeak_SetParameter(espeakPITCH, std::atoi(pitch.c_str()), 0) != EE_OK)
    failure = "espeak-ng does not take the pitch " + pitch + ".";
  if (!send(socket, failure.empty() ? sample_rate : 0, failure) || !failure.empty()) return 1;
  espeak_SetSynthCallback(on_samples);
  g_most = static_cast<std::size_t>(sample_rate) * kLongest;
  while (const auto request = receive(socket, Clock::now() + std::chrono::hours(24))) {
    Samples samples;
    const bool spoken = espeak_SetParameter(espeakRATE, request->value, 0) == EE_OK &&
                        synthesize_below_spaces(request->bytes, samples) == EE_OK &&
                        !samples.empty();
    soften(samples);
    const std::string_view bytes(reinterpret_cast<const char*>(samples.data()),
                                 samples.size() * sizeof(short));
    if (!(spoken ? send(socket, sample_rate, bytes)
                 : send(socket, 0, "espeak-ng does not speak this text.")))
      break;
  }
  return 0;
}

}  // namespace
}  // namespace navvi_feedback::process

int main(int argc, char** argv) {
  return argc == 3 ? navvi_feedback::process::run(argv[1], argv[2]) : 2;
}
