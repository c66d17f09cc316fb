// The program of the voice: sentences in, samples out. espeak-ng may crash or hang, and ends only
// this process then. A request has the words a minute as its value and the text as its bytes. The
// first frame that it sends, and each of the two that answer a request, has the samples' rate in Hz
// as its value and the samples, of 16 bits each, as its bytes; or 0 and a sentence on what failed.
// The first of the two comes as soon as there is enough to begin with; a new request cuts the second
// short.
// Usage: espeak_voice VOICE PITCH

#include <espeak-ng/speak_lib.h>
#include <poll.h>

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
/// s, heard while the rest is synthesized, in some 10 ms.
constexpr double kBegin = 0.25;
constexpr std::ptrdiff_t kRamp = 110;  // samples, 5 ms

/// One sentence, as far as it is synthesized and was not sent.
struct Sentence {
  int socket;
  int rate;  ///< samples a second
  Samples samples = {};
  std::size_t sent = 0;  ///< samples
};

bool send_samples(Sentence& sentence, std::ptrdiff_t count) {
  const auto size = static_cast<std::size_t>(count);
  const std::string_view bytes(reinterpret_cast<const char*>(sentence.samples.data()),
                               size * sizeof(short));
  const bool done = send(sentence.socket, sentence.rate, bytes);
  sentence.samples.erase(sentence.samples.begin(), sentence.samples.begin() + count);
  sentence.sent += size;
  return done;
}

/// From silence, so that it does not click.
template <typename Iterator>
void fade(Iterator sample, std::ptrdiff_t count) {
  for (std::ptrdiff_t i = 0; i < count; ++i, ++sample)
    *sample = static_cast<short>(*sample * i / count);
}

bool asked_again(int socket) {
  pollfd ready{socket, POLLIN, 0};
  return ::poll(&ready, 1, 0) > 0;
}

int on_samples(short* samples, int count, espeak_EVENT* events) {
  auto* sentence = static_cast<Sentence*>(events->user_data);
  if (sentence == nullptr) return 0;
  Samples& all = sentence->samples;
  if (samples != nullptr && count > 0) all.insert(all.end(), samples, samples + count);
  if (all.size() + sentence->sent > static_cast<std::size_t>(sentence->rate * kLongest)) return 1;
  if (sentence->sent > 0) return asked_again(sentence->socket) ? 1 : 0;
  if (static_cast<double>(all.size()) < kBegin * sentence->rate) return 0;
  fade(all.begin(), kRamp);
  return send_samples(*sentence, static_cast<std::ptrdiff_t>(all.size()) - kRamp) ? 0 : 1;
}

/// espeak-ng up to 1.52 (MatchRule in dictionary.c) reads on beyond a word of some languages up to
/// the next space, over the stack above: it finds one here, and does not run off the stack.
[[gnu::noinline]] espeak_ERROR synthesize_below_spaces(const std::string& text, Sentence& sentence) {
  std::array<char, 4096> spaces;
  spaces.fill(' ');
  asm volatile("" : : "r"(spaces.data()) : "memory");
  const espeak_ERROR error = espeak_Synth(text.c_str(), text.size() + 1, 0, POS_CHARACTER, 0,
                                          espeakCHARS_UTF8, nullptr, &sentence);
  asm volatile("" : : "r"(spaces.data()) : "memory");
  return error;
}

/// \return false if nobody listens
bool answer(int socket, int sample_rate, const Frame& request) {
  Sentence sentence{socket, sample_rate};
  const bool spoken = espeak_SetParameter(espeakRATE, request.value, 0) == EE_OK &&
                      synthesize_below_spaces(request.bytes, sentence) == EE_OK;
  const auto left = static_cast<std::ptrdiff_t>(sentence.samples.size());
  const std::ptrdiff_t ramp = std::min(left / 2, kRamp);
  fade(sentence.samples.rbegin(), ramp);
  if (sentence.sent > 0) return send_samples(sentence, left);
  fade(sentence.samples.begin(), ramp);
  const bool begun = spoken && left > 0 ? send_samples(sentence, left)
                                        : send(socket, 0, "espeak-ng does not speak this text.");
  return begun && send_samples(sentence, 0);
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
  while (const auto request = receive(socket, Clock::now() + std::chrono::hours(24)))
    if (!answer(socket, sample_rate, *request)) break;
  return 0;
}

}  // namespace
}  // namespace navvi_feedback::process

int main(int argc, char** argv) {
  return argc == 3 ? navvi_feedback::process::run(argv[1], argv[2]) : 2;
}
