#include <algorithm>
#include <cmath>
#include <utility>

#include "core/guide_parts.hpp"

namespace navvi_feedback::core {

std::optional<Velocity> Guide::Parts::command(const Devices& devices, double dt, double time) {
  const drive::InputState& hands = devices.hands;
  // A device that was opened anew between two ticks was lost between them.
  const bool live = hands.live && (!last_hands.live || hands.session == last_hands.session);
  // A key that drives is itself held.
  const int enable = devices.keyboard ? -1 : config.drive.enable;
  const bool enabled = enable < 0 || hands.button(static_cast<std::size_t>(enable));
  const bool held = teacher.teaching() ? teacher.holds() : senses.holds(time);
  // Where the motors led and no longer do, nobody drives on: by what is heard instead only anew.
  const bool by_hand = config.lead == "hand" || (touch.deaf() && !devices.sounds);
  const bool numb = by_hand && feels && !devices.felt && !teacher.teaching();
  const bool led = devices.sounds && (config.sounds.enabled || (devices.words && devices.voice));
  if (held || !enabled || (numb && (*feels || !led))) drive.disarm();
  if (feels || devices.felt) feels = devices.felt;
  const drive::Stick stick = hands.stick(config.drive.stick == "right");
  const std::optional<Velocity> velocity =
      drive.update(live ? std::optional(stick) : std::nullopt, dt);
  commanded = velocity.value_or(Velocity{});
  const drive::Stick shaped = drive.shaped(stick);
  const bool pushed = live && (shaped.x != 0.0 || shaped.y != 0.0);
  held_unarmed = pushed && enabled && !drive.armed();
  pushed_disabled = pushed && !enabled && !held;
  // The last command of a lost stick is zero; none follows it.
  const bool last = std::exchange(last_hands, hands).live;
  return velocity || last ? std::optional(commanded) : std::nullopt;
}

/// What the person asked for stays the measure of being stuck.
void Guide::Parts::limit(Velocity& command, const Observation& now) const {
  constexpr double kLateShare = 0.25;  // of a command by a stick that comes late
  double fastest = drive::fastest(now.connection.foresight, command, now.nearby);
  if (now.devices.hands.late) {
    fastest = std::min(fastest, kLateShare * std::abs(command.linear));
    command.angular *= kLateShare;
  }
  command.linear = std::clamp(command.linear, -fastest, fastest);
  const double turning = std::abs(command.angular);
  const double most = sounds.turn().most_rate().value_or(turning);
  if (turning > most) command.angular *= most / turning;
}

}  // namespace navvi_feedback::core
