#include "cues/route_rules.hpp"

#include <cmath>
#include <navvi_types/angles.hpp>

#include "cues/way_words.hpp"

namespace navvi_feedback::cues {
namespace {

/// rad to both sides; a robot that has the corner farther aside does not pass it soon.
constexpr double kRoughlyAhead = navvi_types::kPi / 3.0;

/// The robot turns, and will soon face where to steer.
bool about_to_face(const Look& look, const Leg& leg) {
  const std::optional<int> told = leg.said.hour;
  if (told == 12 || !look.now.measured) return false;
  // A turn by one hour is made in one go: there is nothing to stop it by.
  if (told == 1 || told == 11) return false;
  const double angle = look.guidance().steer_angle;
  // Turning left makes what lies ahead wander clockwise.
  const double soon = angle + look.now.measured->angular * look.config.kStraightLead;
  const bool faces = std::abs(navvi_types::wrap(soon)) <= kHour / 2.0;
  const bool crosses = angle * soon < 0.0;
  // A person who hears it more than an hour too early stops short and needs another cue.
  return std::abs(angle) <= kHour && (faces || crosses);
}

bool passes_within_reach(const Look& look) {
  const Guidance& guidance = look.guidance();
  const double across = guidance.waypoint_distance * std::sin(std::abs(guidance.waypoint_angle));
  return std::abs(guidance.waypoint_angle) < kRoughlyAhead && across < look.config.kReach &&
         guidance.waypoint_distance < look.config.kTurnNow;
}

Told end_turn(const Look& look, Leg& leg) {
  if (!look.bearing.turns(look.time)) return std::nullopt;
  if (!about_to_face(look, leg) || hushed(look, leg)) return Utterances{};
  Utterance straight = *direction(look.guidance(), look.bearing);
  straight.kind = CueKind::straight;
  straight.fillings.hour = 12;
  straight.priority = Priority::message;
  if (const auto turn = turn_within_reach(look))
    straight = announce({CueKind::straight, About::then}, straight, *turn, look, leg);
  leg.heard(12, look.time);
  return Utterances{straight};
}

Told turn_at_corner(const Look& look, Leg& leg) {
  return leg.at_corner() && look.hour() != 12 ? Told(turn_now(look, leg)) : std::nullopt;
}

/// Not told, for the direction is; but a sound that comes to lead would tell it.
Told watch_stray(const Look& look, Leg& leg) {
  leg.stray.observe(look.now, look.config.stray, look.time);
  return std::nullopt;
}

Told tell_route(const Look& look, Leg& leg) {
  if (leg.news != Leg::News::other_route || look.hour() == leg.said.hour) return std::nullopt;
  Utterance way = *direction(look.guidance(), look.bearing);
  reroute(way, look, leg);
  leg.heard(look.hour(), look.time);
  return Utterances{way};
}

bool correction_due(const Look& look, const Leg& leg) {
  if (leg.at_corner()) return true;
  const RouteConfig& config = look.config;
  const double angle = std::abs(look.guidance().steer_angle);
  const bool worse =
      look.hour() != 12 && angle > std::abs(leg.said.angle) + config.kWorseDegrees * kDegree;
  if ((look.hour() != leg.said.hour || worse) && !passes_within_reach(look)) return true;
  const double since = look.time - leg.said.time;
  if (look.bearing.idle(look.time)) return since >= 2.0 * config.kRepeatDirection;
  const bool ahead = look.hour() == 12 || look.bearing.leads_off();
  return since >= (ahead ? config.kRepeatStraight : config.kRepeatDirection);
}

Told tell_direction(const Look& look, Leg& leg) {
  const bool due = direction_due(look, leg).value_or(correction_due(look, leg));
  return due ? Told(tell_way(look, leg)) : std::nullopt;
}

}  // namespace

Utterances words_lead(const Look& look, Leg& leg) {
  return first_of({make_room, end_turn, turn_at_corner, listen, watch_stray, tell_route,
                   cancel_turn, urge, tell_direction, announce_turn},
                  look, leg);
}

}  // namespace navvi_feedback::cues
