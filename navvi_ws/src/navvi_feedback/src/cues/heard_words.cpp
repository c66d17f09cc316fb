#include "cues/heard_words.hpp"

namespace navvi_feedback::cues {

std::vector<CueEvent> HeardWords::of(std::vector<CueEvent> events, bool heard) {
  std::vector<CueEvent> result;
  for (CueEvent& event : events) {
    if (event.stage == CueStage::started && !heard) {
      unheard_ = event.id;
      event.stage = CueStage::dropped;
    } else if (event.id == unheard_) {
      continue;
    }
    result.push_back(event);
  }
  return result;
}

}  // namespace navvi_feedback::cues
