#include "cues/route_rules.hpp"

#include <algorithm>

#include "cues/surroundings.hpp"
#include "cues/way_words.hpp"

namespace navvi_feedback::cues {
namespace {

/// Near and roughly ahead, as the person was told, and driven to.
bool at_hand(const Look& look, const Leg& leg) {
  const auto ahead = [](std::optional<int> hour) { return hour && (*hour >= 11 || *hour == 1); };
  return look.guidance().waypoint_distance < look.config.kAtHand && ahead(look.hour()) &&
         ahead(leg.said.hour) && !look.bearing.idle(look.time);
}

}  // namespace

Utterances first_of(std::initializer_list<Rule> rules, const Look& look, Leg& leg) {
  for (const Rule rule : rules)
    if (Told told = rule(look, leg)) return *told;
  return {};
}

Told make_room(const Look& look, Leg& leg) {
  if (look.guidance().state != Guidance::State::make_room || leg.room_made) return std::nullopt;
  if (look.now.voice_busy && look.time - leg.unheard < kTryAgain) return Utterances{};
  leg.heard(look.hour(), look.time);
  return Utterances{make_room_now(look, leg)};
}

Told listen(const Look& look, Leg&) {
  return look.now.voice_busy ? Told(Utterances{}) : std::nullopt;
}

Told cancel_turn(const Look& look, Leg& leg) {
  if (!leg.fell_away || turn_within_reach(look) || look.hour() != 12) return std::nullopt;
  Utterance way = *direction(look.guidance(), look.bearing);
  way.kind = CueKind::turn_cancelled;
  leg.heard(look.hour(), look.time);
  return Utterances{way};
}

Told announce_turn(const Look& look, Leg& leg) {
  const std::optional<int> turn = turn_within_reach(look);
  if (!turn || leg.turn_told || look.hour() != 12) return std::nullopt;
  if (look.guidance().waypoint_distance <= look.config.kTurnNow) return std::nullopt;
  const bool again = turn == leg.turn.hour && look.time - leg.turn.time < look.config.kSameTurn;
  if (again || look.time - leg.said.time < look.config.kPause) return std::nullopt;
  const Utterance way = *direction(look.guidance(), look.bearing);
  return Utterances{announce(CueKind::turn_ahead, way, *turn, look, leg)};
}

Told urge(const Look& look, Leg& leg) {
  if (look.hour() != 12 || !leg.hand.due(look.time, 2.0 * look.config.kRepeatDirection))
    return std::nullopt;
  const double free = std::min(look.config.kInTheWay, look.guidance().waypoint_distance);
  if (anything_ahead(look.now.nearby, free)) return std::nullopt;
  // The sound of a turn that it made has ended.
  if (leg.said.hour != 12) return tell_way(look, leg);
  leg.heard(12, look.time);
  leg.hand.urged = look.time;
  return Utterances{{CueKind::push}};
}

Utterances tell_way(const Look& look, Leg& leg) {
  Utterance way = *direction(look.guidance(), look.bearing);
  // Without the turn a person drives past it.
  if (const auto turn = turn_within_reach(look); turn && look.hour() == 12)
    return {announce({CueKind::straight, About::then}, way, *turn, look, leg)};
  // The route changed while the person waited.
  if (!leg.said.hour && leg.routes.news(look.guidance()) && way.kind != CueKind::slight)
    reroute(way, look, leg);
  leg.heard(look.hour(), look.time);
  return {way};
}

Utterances turn_now(const Look& look, Leg& leg) {
  Utterance way = *direction(look.guidance(), look.bearing);
  if (look.bearing.leads_off())
    way.priority = Priority::message;
  else
    way.kind = CueKind::turn_now;
  if (const auto turn = turn_within_reach(look);
      turn && look.config.join && look.guidance().waypoint_distance < look.config.kNextTurn)
    way.also = {announce(CueKind::turn_ahead, way, *turn, look, leg)};
  leg.heard(look.hour(), look.time);
  return {way};
}

Utterance make_room_now(const Look& look, Leg& leg) {
  leg.room_made = true;
  Utterance way = *direction(look.guidance(), look.bearing);
  way.kind = CueKind::make_room;
  way.fillings.thing = look.guidance().blocked_by.value_or(ThingClass::other);
  return way;
}

Utterance announce(const Content& what, Utterance way, int hour, const Look& look, Leg& leg) {
  static_cast<Content&>(way) = what;
  way.fillings.hour = hour;
  leg.announced(hour, look.time);
  leg.heard(look.hour(), look.time);
  return way;
}

bool is_blocked(const Look& look, const Leg& leg) {
  const Guidance::Replan reason = look.guidance().reroute_reason;
  const bool closed =
      reason == Guidance::Replan::path_carved || reason == Guidance::Replan::waypoint_blocked;
  return leg.routes.news(look.guidance()) && closed;
}

void reroute(Utterance& way, const Look& look, const Leg& leg) {
  way.kind = CueKind::rerouted;
  if (is_blocked(look, leg)) way.about = About::blocked;
}

std::optional<bool> direction_due(const Look& look, const Leg& leg) {
  if (!leg.said.hour) return true;
  if (look.time - leg.said.time < look.config.kPause) return false;
  if (look.hour() == 12 && hushed(look, leg)) return false;
  if (leg.reminder && look.time >= *leg.reminder) return true;
  return at_hand(look, leg) ? std::optional(false) : std::nullopt;
}

std::optional<int> turn_within_reach(const Look& look) {
  const Guidance& guidance = look.guidance();
  const auto turn = clock_hour(guidance.turn_angle, look.bearing.rounding());
  const bool announced = turn && !guidance.waypoint_is_goal && worth_words(look, *turn) &&
                         guidance.waypoint_distance <= look.config.turn_ahead;
  return announced ? turn : std::nullopt;
}

bool worth_words(const Look& look, int hour) {
  const bool bend = hour == 1 || hour == 11;
  return hour != 12 && !(bend && look.by_sound());
}

bool hushed(const Look& look, const Leg& leg) {
  if (!look.config.join || !leg.reminder) return false;
  if (look.time >= *leg.reminder + look.config.kStillAhead) return false;
  const double free = std::min(look.config.kInTheWay, look.guidance().waypoint_distance);
  return look.time < *leg.reminder || anything_ahead(look.now.nearby, free);
}

}  // namespace navvi_feedback::cues
