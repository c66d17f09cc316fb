#pragma once

#include <optional>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Why the guidance does not lead anywhere; nullopt if it does.
[[nodiscard]] std::optional<CueKind> problem_of(const Guidance& guidance);

/// That, with the thing that is in the way.
[[nodiscard]] Utterance problem_words(CueKind problem, const Observation& now);

/// A goal was refused, for whatever reason.
[[nodiscard]] inline bool is_refusal(std::optional<CueKind> problem) {
  return problem && family_of(*problem) == Family::refusal;
}

}  // namespace navvi_feedback::cues
