#include "cues/problem.hpp"

namespace navvi_feedback::cues {
namespace {

CueKind refusal_of(Guidance::Refusal refusal) {
  switch (refusal) {
    case Guidance::Refusal::none:  // unexplained
    case Guidance::Refusal::not_finite:
      return CueKind::goal_refused_not_finite;
    case Guidance::Refusal::unknown_frame:
      return CueKind::goal_refused_unknown_frame;
    case Guidance::Refusal::inside_obstacle:
      return CueKind::goal_refused_inside_obstacle;
    case Guidance::Refusal::off_the_map:
      return CueKind::goal_refused_off_the_map;
    case Guidance::Refusal::unreachable:
      return CueKind::goal_refused_unreachable;
    case Guidance::Refusal::not_seen:
      return CueKind::goal_refused_not_seen;
  }
  return CueKind::goal_refused_not_finite;
}

}  // namespace

std::optional<CueKind> problem_of(const Guidance& guidance) {
  switch (guidance.state) {
    case Guidance::State::no_goal:
      return CueKind::welcome;
    case Guidance::State::following:
    case Guidance::State::make_room:
      return std::nullopt;
    case Guidance::State::goal_refused:
      return refusal_of(guidance.refusal);
    case Guidance::State::arrived:
      return CueKind::arrived;
    case Guidance::State::blocked:
      return CueKind::blocked;
    case Guidance::State::no_route:
      return CueKind::no_route;
    case Guidance::State::off_mesh:
      return CueKind::off_mesh;
    case Guidance::State::no_map:
      return CueKind::no_map;
    case Guidance::State::map_stale:
      return CueKind::map_stale;
    case Guidance::State::pose_stale:
      return CueKind::pose_stale;
  }
  return std::nullopt;
}

Utterance problem_words(CueKind problem, const Observation& now) {
  Utterance told{problem};
  if (now.guidance) told.fillings.thing = now.guidance->blocked_by.value_or(ThingClass::other);
  return told;
}

}  // namespace navvi_feedback::cues
