#include "cues/route_rules.hpp"

#include <algorithm>

#include "cues/surroundings.hpp"
#include "cues/way_words.hpp"

namespace navvi_feedback::cues {
namespace {

Told leave_turn(const Look& look, Leg&) {
  return look.bearing.turns(look.time) ? Told(Utterances{}) : std::nullopt;
}

Told turn_at_corner(const Look& look, Leg& leg) {
  if (!leg.at_corner() || look.hour() == 12) return std::nullopt;
  // The sound leads round what was announced; the words for the leg follow once the robot faces it.
  if (leg.news == Leg::News::told_corner) return Utterances{};
  if (worth_words(look, look.hour())) return turn_now(look, leg);
  leg.news = Leg::News::none;
  return Utterances{};
}

/// Without the direction, which the sound tells.
Told tell_route(const Look& look, Leg& leg) {
  if (leg.news != Leg::News::other_route) return std::nullopt;
  leg.news = Leg::News::none;
  if (!leg.routes.news(look.guidance())) return Utterances{};
  Utterance way = *direction(look.guidance(), look.bearing);
  way.kind = CueKind::new_route;
  way.about = is_blocked(look, leg) ? About::way_blocked : About::new_route;
  leg.routes.tell(look.guidance().reroutes);
  return Utterances{way};
}

/// With the way back.
Told tell_stray(const Look& look, Leg& leg) {
  leg.stray.observe(look.now, look.config.stray, look.time);
  if (!leg.stray.due(look.now, look.config.stray, look.time)) return std::nullopt;
  leg.stray.said = look.time;
  Utterance way = *direction(look.guidance(), look.bearing);
  way.kind = *leg.stray.kind;
  way.fillings.side = look.guidance().steer_angle > 0.0 ? Side::right : Side::left;
  if (way.kind == CueKind::off_path) way.fillings.distance = look.guidance().path_offset;
  leg.heard(look.hour(), look.time);
  return Utterances{way};
}

/// A leg has words at its begin, and again while it goes on; a short one has those of its end.
bool leg_due(const Look& look, const Leg& leg) {
  const double since = look.time - leg.said.time;
  if (look.bearing.idle(look.time))
    return leg.at_corner() || since >= 2.0 * look.config.kRepeatDirection;
  const bool goes_on = look.hour() == 12 && since >= look.config.kRepeatStraight;
  return (leg.at_corner() || goes_on) && look.guidance().waypoint_distance >= look.config.kLongLeg;
}

Told tell_direction(const Look& look, Leg& leg) {
  // The sound leads anyway, and a word to stop may follow.
  const double free = std::min(look.config.kComing, look.guidance().waypoint_distance);
  if (look.hour() == 12 && anything_ahead(look.now.nearby, free, true)) return std::nullopt;
  const bool due = direction_due(look, leg).value_or(leg_due(look, leg));
  return due ? Told(tell_way(look, leg)) : std::nullopt;
}

}  // namespace

Utterances sounds_lead(const Look& look, Leg& leg) {
  return first_of({make_room, leave_turn, turn_at_corner, tell_route, listen, tell_stray,
                   cancel_turn, urge, tell_direction, announce_turn},
                  look, leg);
}

Utterances words_beside(const Look& look, Leg& leg) {
  if (leg.at_corner()) leg.news = Leg::News::none;
  return first_of({make_room, tell_route, listen, tell_stray}, look, leg);
}

}  // namespace navvi_feedback::cues
