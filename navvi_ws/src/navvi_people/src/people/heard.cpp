#include "navvi_people/people/heard.hpp"

namespace navvi_people::people {

std::optional<Heard> heard(const CueEvent& cue) {
  using navvi_types::CueStage;
  using Moment = Speech::Moment;
  if (const auto* const earcon = std::get_if<Earcon>(&cue.what))
    return Sound{*earcon, cue.left, cue.right};
  if (cue.modality() != navvi_types::Modality::speech) return std::nullopt;
  switch (cue.stage) {
    case CueStage::started:
      return Speech{cue.id, Moment::begins, cue.text};
    case CueStage::ended:
      return Speech{cue.id, Moment::ends};
    case CueStage::cut:
      return Speech{cue.id, Moment::breaks_off};
    case CueStage::queued:
    case CueStage::dropped:
      break;
  }
  return std::nullopt;
}

}  // namespace navvi_people::people
