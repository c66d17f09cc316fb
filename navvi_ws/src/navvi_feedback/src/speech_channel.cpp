#include "navvi_feedback/speech_channel.hpp"

#include <utility>

namespace navvi_feedback {

std::vector<CueEvent> SpeechChannel::tick(const std::vector<Cue>& new_cues, double time) {
  return apply(queue_.update(new_cues, speaker_.busy(), time));
}

std::vector<CueEvent> SpeechChannel::finish() { return apply(queue_.clear()); }

std::vector<CueEvent> SpeechChannel::apply(CueQueue::Step step) {
  if (step.stop) speaker_.stop();
  if (step.start) speaker_.start(*step.start);
  return std::move(step.events);
}

}  // namespace navvi_feedback
