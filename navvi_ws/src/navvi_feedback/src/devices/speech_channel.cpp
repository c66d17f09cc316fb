#include "devices/speech_channel.hpp"

#include <utility>

namespace navvi_feedback::devices {

std::vector<CueEvent> SpeechChannel::tick(const std::vector<cues::Cue>& new_cues, double time) {
  return apply(queue_.update(new_cues, speaker_.busy(), time));
}

std::vector<CueEvent> SpeechChannel::finish() { return apply(queue_.clear()); }

std::vector<CueEvent> SpeechChannel::apply(cues::CueQueue::Step step) {
  if (step.stop) speaker_.stop();
  if (step.start) speaker_.start(*step.start);
  return std::move(step.events);
}

}  // namespace navvi_feedback::devices
