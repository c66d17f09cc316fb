#pragma once

#include <optional>

#include "cues/bearing.hpp"
#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// The direction as of now. \return nullopt: none is known
[[nodiscard]] std::optional<Utterance> direction(const Guidance& guidance, const Bearing& bearing);

/// Where the next turn is, and where it leads.
[[nodiscard]] Utterance next_turn(const Guidance& guidance, Rounding rounding);

/// How far the goal is, and where from the nose, as goal_words() has both.
[[nodiscard]] Utterance start_words(const Observation& now, Rounding rounding);

/// Distance and, if it is known, hour of the goal.
[[nodiscard]] Utterance goal_words(CueKind kind, const Observation& now, Rounding rounding);

}  // namespace navvi_feedback::cues
