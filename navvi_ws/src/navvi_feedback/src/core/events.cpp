#include "core/events.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::core {

CueEvent rumble_event(const haptics::Rumble& rumble, std::optional<haptics::Pattern> pattern,
                      std::uint32_t id) {
  return {id,          CueStage::started, navvi_types::Felt{pattern}, "", Priority::progress,
          rumble.left, rumble.right};
}

CueEvent sound_event(const sounds::Play& play, std::uint32_t id) {
  const double distance = play.from.norm();
  const double leftness = distance > 0.0 ? play.from.y() / distance : 0.0;
  return {id,
          CueStage::started,
          play.earcon,
          "",
          Priority::progress,
          play.volume * 0.5 * (1.0 + leftness),
          play.volume * 0.5 * (1.0 - leftness)};
}

CueEvent flow_event(const haptics::Rumble& flow, std::uint32_t id) {
  return {id,        CueStage::started, sounds::Earcon::flow, "", Priority::progress,
          flow.left, flow.right};
}

std::optional<sounds::Play> sound_of(const CueEvent& event) {
  const auto* const earcon = std::get_if<sounds::Earcon>(&event.what);
  if (earcon == nullptr || *earcon == sounds::Earcon::flow) return std::nullopt;
  const double volume = event.left + event.right;
  if (!(volume > 0.0)) return std::nullopt;
  const double leftness = (event.left - event.right) / volume;
  return sounds::Play{
      *earcon, {std::sqrt(std::max(0.0, 1.0 - leftness * leftness)), leftness}, volume};
}

}  // namespace navvi_feedback::core
