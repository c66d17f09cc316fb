#include "devices/speech_channel.hpp"

#include <utility>

namespace navvi_feedback::devices {

std::vector<CueEvent> SpeechChannel::tick(const std::vector<cues::Cue>& new_cues, double time,
                                          bool pressed) {
  if (pressed) pressed_ = Latencies::Clock::now();
  return apply(queue_.update(new_cues, speaker_.busy(), time));
}

std::vector<CueEvent> SpeechChannel::finish() { return apply(queue_.clear()); }

std::vector<CueEvent> SpeechChannel::apply(cues::CueQueue::Step step) {
  const auto now = Latencies::Clock::now();
  const auto timed = [&](Chain chain, Latencies::Clock::time_point cause) {
    return [this, chain, cause] { latencies_.add(chain, cause); };
  };
  if (step.stop) speaker_.stop(timed(Chain::silence, now));
  if (step.start && step.asked)
    speaker_.start(*step.start, timed(Chain::answer, std::exchange(pressed_, {}).value_or(now)),
                   step.scan);
  else if (step.start)
    speaker_.start(*step.start, timed(Chain::words, now));
  return std::move(step.events);
}

}  // namespace navvi_feedback::devices
