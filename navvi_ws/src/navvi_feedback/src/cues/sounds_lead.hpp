#pragma once

#include "cues/route_rules.hpp"

namespace navvi_feedback::cues {

/// The strategy where a sound leads to where to steer: words are for what it cannot tell. Each leg
/// once, turns of more than one hour, another route, and driving astray.
/// \return what is said now; the leg knows of it
[[nodiscard]] Utterances sounds_lead(const Look& look, Leg& leg);

/// Likewise where a display leads that lasts: words are for what is behind a change of the way.
[[nodiscard]] Utterances words_beside(const Look& look, Leg& leg);

}  // namespace navvi_feedback::cues
