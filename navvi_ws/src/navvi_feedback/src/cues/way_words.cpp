#include "cues/way_words.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::cues {

std::optional<Utterance> direction(const Guidance& guidance, const Bearing& bearing) {
  // The held hour, so that an answer agrees with what was said; a fresh one where none is.
  const std::optional<int> hour =
      bearing.hour() ? bearing.hour() : clock_hour(guidance.steer_angle, bearing.rounding());
  if (!hour || !std::isfinite(guidance.waypoint_distance)) return std::nullopt;
  Utterance way;
  way.kind = bearing.leads_off() ? CueKind::slight
             : *hour == 12       ? CueKind::straight
                                 : CueKind::direction;
  way.fillings.hour = hour;
  way.fillings.side = *hour < 6 ? Side::right : Side::left;
  way.fillings.distance = std::max(0.0, guidance.waypoint_distance);
  return way;
}

Utterance next_turn(const Guidance& guidance, Rounding rounding) {
  Utterance turn{CueKind::turn_ahead};
  turn.fillings.hour = clock_hour(guidance.turn_angle, rounding).value_or(12);
  turn.fillings.distance = std::max(0.0, guidance.waypoint_distance);
  return turn;
}

Utterance start_words(const Observation& now, Rounding rounding) {
  if (now.guidance->ends_short) return {CueKind::toward_goal};
  Utterance start = goal_words(CueKind::start, now, rounding);
  if (now.goal_angle)
    start.fillings.side = side_of({std::cos(*now.goal_angle), -std::sin(*now.goal_angle)});
  return start;
}

Utterance goal_words(CueKind kind, const Observation& now, Rounding rounding) {
  const auto hour = now.goal_angle ? clock_hour(*now.goal_angle, rounding) : std::nullopt;
  // Where the path ends before the goal, its length tells nothing of that.
  if (!now.guidance->ends_short)
    return {{kind, hour ? About::none : About::distance},
            {hour, std::max(0.0, now.guidance->goal_distance)}};
  const Content seen_from_here = hour ? Content(CueKind::where, About::goal) : CueKind::toward_goal;
  return {seen_from_here, {hour, now.goal_straight}};
}

}  // namespace navvi_feedback::cues
