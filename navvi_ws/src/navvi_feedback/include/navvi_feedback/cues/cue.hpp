#pragma once

#include <navvi_types/cue_event.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback {
using navvi_types::CueEvent;
using navvi_types::CueStage;
using navvi_types::Priority;
}  // namespace navvi_feedback

namespace navvi_feedback::cues {

struct Situation;  // what cues are decided from
struct Utterance;  // what is to be told, before it is put into words

/// One spoken message, before it is spoken.
struct Cue {
  std::string kind;  ///< the phrase's key, such as turn_now
  std::string text;  ///< as spoken
  Priority priority = Priority::text;
  double max_age = 2.0;                    ///< s after which it is dropped if it has not begun
  std::optional<sounds::Play> sound = {};  ///< played instead of the words
  bool asked = false;                      ///< the answer to a button
  bool goes_on = false;                    ///< it ends a wait: "go on", and where to
  bool felt = false;                       ///< only: its words were said just now
  /// Each sounds before one of the parts of the words, which commas separate.
  std::vector<sounds::Play> scan = {};
};

/// Kinds that are treated alike.
enum class Family {
  other,
  hit,    ///< something was touched
  halt,   ///< to stop, until it is said to go on
  way,    ///< where to steer, as the person may do without
  route,  ///< where to steer, as they may not
  near,   ///< what is near, where nothing need be done
};

/// It tells where to steer.
[[nodiscard]] constexpr bool is_way(Family family) {
  return family == Family::way || family == Family::route;
}

/// How a kind of cue is treated.
struct CueKind {
  const char* kind;
  Priority priority;
  double min_interval;  ///< s, the least time between two of the same kind
  double max_age;       ///< s, as Cue::max_age
  Family family = Family::other;
};

/// Every kind there is. Each has a phrase.
[[nodiscard]] const std::vector<CueKind>& cue_kinds();
/// \throws std::logic_error for a kind that is none
[[nodiscard]] const CueKind& cue_kind(const std::string& kind);
/// Family::other for what is no kind of cue, such as a pattern or a text of a lesson.
[[nodiscard]] Family family_of(const std::string& kind);

}  // namespace navvi_feedback::cues
