#include <navvi_types/angles.hpp>

#include "core/guide_parts.hpp"

namespace navvi_feedback::core {

/// As far as the person hears or feels it.
Lead Guide::Parts::leading(const Observation& now) const {
  // A lesson teaches turns by ticks, whatever leads later.
  if (teacher.speaks()) return now.audible ? Lead::ticks : Lead::words;
  const Lead wanted = navvi_types::from_word<Lead>(config.lead).value_or(Lead::words);
  const bool deaf = touch.deaf() && !now.devices.sounds;
  if ((wanted == Lead::hand || deaf) && now.motors) return Lead::hand;
  // Where the sides are wrong no sound leads, be it ticks or one that lasts.
  if (!now.audible || wanted == Lead::words || !sounds.turn().leads()) return Lead::words;
  return wanted == Lead::flow && following.follows() ? Lead::flow : Lead::ticks;
}

/// Before a trial, of a person whom sounds are to lead, by each sound device once.
void Guide::Parts::ask_side(Observation& now, double time, Output& out) {
  const Devices& devices = now.devices;
  const bool known = devices.ears.empty() || devices.ears == config.sounds.sides;
  const bool by_sounds = now.lead == Lead::ticks || now.lead == Lead::flow;
  const bool may = !known && by_sounds && devices.words && devices.hands.live &&
                   !teacher.teaching() && now.trial == TrialState::State::ready;
  const std::optional<bool> right = side.update(may, !now.voice_busy, now.stick.x, time);
  if (right == false) sounds.turn().find_sides_wrong();
  if (right == true && !devices.person.empty()) out.change = "sounds/sides:=" + devices.ears;
  now.side_asked = side.asks();
  if (side.sounds()) {
    out.plays.push_back(sounds.sample(sounds::Earcon::turn));
    out.plays.back().from = {0.0, *side.sounds()};
  }
  if (const auto learnt = sounds.learnt(); learnt && learnt->sides_wrong)
    now.notices.push_back(CueKind::sides_wrong);
}

AuditoryDisplay::Steering Guide::Parts::steering(const Observation& now, double dt) {
  const bool drives = now.commanded.linear != 0.0 || now.commanded.angular != 0.0;
  idle = policy.leads() && !drives ? idle + dt : 0.0;
  return {off_course(now), policy.leads_off(), teacher.taught().motion.value_or(now.last_measured)};
}

std::optional<double> Guide::Parts::off_course(const Observation& now) const {
  constexpr double kIdle = 6.0;  // s; who does not drive for so long needs no ticks to turn by
  if (teacher.speaks()) return teacher.taught().off;
  const bool awake = lasts(now.lead) || idle <= kIdle;
  const bool led = now.links.guidance == Link::alive && policy.leads() && awake;
  if (!led) return std::nullopt;
  return navvi_types::wrap(now.guidance->steer_angle + now.turned);
}

}  // namespace navvi_feedback::core
