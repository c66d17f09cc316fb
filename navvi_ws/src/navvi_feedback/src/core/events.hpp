#pragma once

#include <navvi_types/cue_event.hpp>
#include <optional>

#include "haptics/pattern.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::core {

/// As a navvi_msgs/Cue, of the kind of its pattern, or "rumble".
/// \param id  counts the changes of the motors
[[nodiscard]] CueEvent rumble_event(const haptics::Rumble& rumble,
                                    std::optional<haptics::Pattern> pattern, std::uint32_t id);
/// Likewise, of the kind of its earcon; its volume is shared by the two sides.
/// \param id  counts the sounds
[[nodiscard]] CueEvent sound_event(const sounds::Play& play, std::uint32_t id);
/// Of what lasts: it sounds so from now on. \param flow  shares of both ears
[[nodiscard]] CueEvent flow_event(const haptics::Rumble& flow, std::uint32_t id);
/// What such an event tells to play; nullopt if it is none, or lasts. Ahead and behind are the same.
[[nodiscard]] std::optional<sounds::Play> sound_of(const CueEvent& event);

}  // namespace navvi_feedback::core
