#include "cues/leg.hpp"

#include <cmath>
#include <navvi_types/angles.hpp>
#include <utility>

#include "cues/clock_face.hpp"

namespace navvi_feedback::cues {

bool drives_on(const Observation& now) {
  constexpr double kTurns = 0.1;  // m/s; a slower robot is about to turn on the spot
  return now.measured && now.measured->linear > kTurns;
}

std::optional<CueKind> straying(const Observation& now, std::optional<CueKind> was,
                                const StrayConfig& config) {
  if (drives_on(now) && std::abs(now.guidance->steer_angle) > config.kWrongWayDegrees * kDegree)
    return CueKind::wrong_way;
  const double limit = was == CueKind::off_path ? config.kOnPath : config.kOffPath;
  return now.guidance->path_offset > limit ? std::optional(CueKind::off_path) : std::nullopt;
}

void Stray::observe(const Observation& now, const StrayConfig& config, double time) {
  const std::optional<CueKind> strays = straying(now, kind, config);
  if (strays != kind) *this = {strays, time, std::nullopt};
}

bool Stray::due(const Observation& now, const StrayConfig& config, double time) const {
  return kind && time - since >= config.kAfter && drives_on(now) &&
         (!said || time - *said >= config.kRepeat);
}

void StillHand::observe(const Observation& now, double time) {
  const bool drives = std::abs(now.commanded.linear) > now.kNeutral.linear;
  const bool turns = std::abs(now.commanded.angular) > now.kNeutral.angular;
  driven = driven || drives;
  const bool in_vain = now.stick_held_unarmed || now.stick_disabled;  // HeldStick says what helps
  since = since_when(!drives && !turns && !in_vain && !now.voice_busy, since, time);
}

bool StillHand::due(double time, double again) const {
  constexpr double kStill = 3.0;  // s; a person who begins by themselves does so within that
  return !driven && since && time - *since >= kStill && !(urged && time - *urged < again);
}

void ToldRoutes::tell(std::uint32_t reroutes) { before = std::exchange(told, reroutes); }

void Leg::begin(const Guidance& guidance) {
  news = News::none;
  said.hour.reset();
  routes = {guidance.reroutes, guidance.reroutes};
}

bool Leg::ends(const Guidance& guidance, double same) const {
  return seen && (guidance.waypoint - seen->corner).norm() > same;
}

Leg::News Leg::change_to(const Guidance& guidance, const RouteConfig& config) const {
  if (!ends(guidance, config.kSameCorner)) return News::none;
  const bool rerouted = guidance.reroutes != seen->reroutes;
  if (seen->distance <= config.kTurnNow && !rerouted)
    return turn_told ? News::told_corner : News::corner;
  // Seen from one place at one instant: only the plan can have changed the hour.
  const double moved = navvi_types::wrap(guidance.waypoint_angle - seen->angle);
  return std::abs(moved) > kHour / 2.0 ? News::other_route : News::none;
}

void Leg::advance(const Guidance& guidance, std::optional<int> next, const RouteConfig& config) {
  if (guidance.state != Guidance::State::make_room) room_made = false;
  const News change = change_to(guidance, config);
  const bool reached = change == News::corner || change == News::told_corner;
  if (reached || (change == News::other_route && !at_corner())) news = change;
  const bool other = ends(guidance, config.kSameCorner);
  if (other && turn_told && !reached) fell_away = !next;
  if (!seen || reached || (other && next != turn.hour)) turn_told = false;
  seen = {guidance.waypoint, guidance.waypoint_distance, guidance.waypoint_angle,
          guidance.steer_angle, guidance.reroutes};
}

void Leg::heard(int hour, double time) {
  if (at_corner() || hour != said.hour) hand = {};
  said = {hour, time, seen ? seen->steer : 0.0};
  // A route whose way was told is not news later on.
  if (seen) routes.tell(seen->reroutes);
  news = News::none;
  fell_away = false;
  reminder.reset();
}

void Leg::announced(int hour, double time) {
  turn = {hour, time};
  turn_told = true;
}

void Leg::lost(double time) {
  unheard = time;
  said.hour.reset();
  room_made = turn_told = false;
  routes.told = routes.before;
}

void Leg::route_lost(bool by_sound) {
  routes.told = routes.before;
  news = News::other_route;
  if (!by_sound) said.hour.reset();
}

void Leg::pause() {
  seen.reset();
  said.hour.reset();
  news = News::none;
  fell_away = room_made = false;
}

}  // namespace navvi_feedback::cues
