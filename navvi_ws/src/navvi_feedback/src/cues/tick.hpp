#pragma once

#include <optional>

#include "cues/phrases.hpp"
#include "navvi_feedback/drive/button.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

using drive::Button;

/// What the buttons of a tick come to, once a lesson and the menu took theirs.
struct Asked {
  std::optional<Utterance> menu;     ///< what the menu answers
  bool menu_closed = false;          ///< by itself
  std::optional<Button> question;    ///< whose button went down
};

/// One instant, as each part of the policy sees it.
struct Tick {
  const Observation& now;
  const Asked& asked;
  Links links;           ///< as judged
  bool follows = false;  ///< there is a fresh path that is to be followed now
  double time = 0.0;     ///< s, monotonic
  double age = 0.0;      ///< s, since the first tick
};

/// The act that a trial awaits before it begins; nullopt if none.
[[nodiscard]] inline std::optional<Content> awaited(const Observation& now) {
  if (now.trial == TrialState::State::choose_goal) return CueKind::choose_goal;
  if (now.trial != TrialState::State::ready) return std::nullopt;
  if (now.side_asked) return CueKind::which_side;
  if (now.task != TrialState::Task::drive && is_place_name(now.reached))
    return Content{CueKind::press, navvi_types::from_word<About>(to_string(now.task)).value()};
  return Content{CueKind::press, now.devices.keyboard ? About::enter : About::start};
}

}  // namespace navvi_feedback::cues
