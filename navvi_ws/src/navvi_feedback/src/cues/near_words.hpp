#pragma once

#include <optional>
#include <vector>

#include "cues/phrases.hpp"
#include "navvi_feedback/sounds/earcon.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

[[nodiscard]] sounds::Earcon earcon_of(ThingClass thing);

/// What is heard instead of such words, where sounds do their work.
[[nodiscard]] std::optional<sounds::Play> instead_of(const Utterance& utterance,
                                                     const Sounds& sounds);

/// What is around: the nearest thing on each side, the nearest of all first, then clockwise, each
/// with its gap and where it is, for a person who asks.
[[nodiscard]] Utterance around(const std::vector<NearThing>& nearby);

/// Before what, and how far from it, the robot stops that is let go now; nullopt: nothing is so near.
[[nodiscard]] std::optional<Utterance> stops_before(const std::vector<NearThing>& nearby,
                                                    double stops_in);

/// Words about a thing on a side. \param urgent  the robot drives at it
[[nodiscard]] Utterance near_words(const Content& content, ThingClass thing, Side side,
                                   bool urgent);

}  // namespace navvi_feedback::cues
