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
  Utterance goal{kind};
  if (now.goal_angle) goal.fillings.hour = clock_hour(*now.goal_angle, rounding);
  // The path ends before the goal: how long it is tells nothing of that.
  const bool beyond = now.guidance->ends_short;
  goal.fillings.distance = beyond ? now.goal_straight : std::max(0.0, now.guidance->goal_distance);
  if (beyond)
    goal.kind = goal.fillings.hour ? CueKind::where_goal : CueKind::toward_goal;
  else if (!goal.fillings.hour)
    goal.about = About::distance;
  return goal;
}

}  // namespace navvi_feedback::cues
