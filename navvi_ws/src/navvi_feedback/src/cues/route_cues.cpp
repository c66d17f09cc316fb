#include "cues/route_cues.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cues/route_rules.hpp"
#include "cues/way_words.hpp"

namespace navvi_feedback::cues {

Utterances RouteCues::update(const Observation& now, bool halted, double time) {
  const Guidance& guidance = *now.guidance;
  by_sound_ = now.lead != Lead::words;
  if (leg_.ends(guidance, config_.kSameCorner)) bearing_.begin_leg();
  bearing_.observe(now, halted, time);
  if (!bearing_.hour() || !std::isfinite(guidance.waypoint_distance)) return {};
  const Look look{config_, now, bearing_, time};
  leg_.advance(guidance, turn_within_reach(look), config_);
  leg_.hand.observe(now, time);
  if (halted) {
    leg_.stand();
    leg_.hand.since.reset();
    return {};
  }
  // Room is made first.
  const bool aside = guidance.state == Guidance::State::make_room;
  if (is_new_goal(guidance) && !aside) return introduce_goal(look);
  Utterances told = sight_of_goal(now, time);
  const Utterances led = lasts(now.lead) ? words_beside(look, leg_)
                         : by_sound_     ? sounds_lead(look, leg_)
                                         : words_lead(look, leg_);
  told.insert(told.end(), led.begin(), led.end());
  return told;
}

/// That the map does not show the goal yet, and that it does now: each once.
Utterances RouteCues::sight_of_goal(const Observation& now, double time) {
  const Guidance& guidance = *now.guidance;
  if (!goal_ || guidance.state == Guidance::State::make_room ||
      guidance.ends_short == unseen_.told || time - unseen_.time < kTryAgain)
    return {};
  unseen_.told = guidance.ends_short;
  unseen_.time = time;
  Utterance sight{unseen_.told ? CueKind::toward_goal : CueKind::goal_seen};
  sight.fillings.distance = std::max(0.0, guidance.goal_distance);
  return {sight};
}

/// First of all what to do now; but that the goal is not seen yet comes before it.
Utterances RouteCues::introduce_goal(const Look& look) {
  goal_ = look.guidance().goal;
  unseen_ = {look.guidance().ends_short, false, false, look.time};
  leg_.begin(look.guidance());
  Utterances told;
  if (lasts(look.now.lead))
    leg_.heard(look.hour(), look.time);
  else
    told = tell_way(look, leg_);
  told.insert(unseen_.told ? told.begin() : told.end(), start_words(look.now, look.bearing.rounding()));
  return told;
}

Utterances RouteCues::go_on(const Observation& now, double time) {
  const Guidance& guidance = *now.guidance;
  std::optional<Utterance> way = direction(guidance, bearing_);
  if (!way) return {};
  const Look look{config_, now, bearing_, time};
  if (guidance.state == Guidance::State::make_room) {
    way = make_room_now(look, leg_);
  } else if (is_new_goal(guidance)) {
    // That the goal is not seen yet is told by itself, as there may be no room for it here.
    if (!guidance.ends_short)
      way->also = {goal_words(CueKind::goal_info, now, bearing_.rounding())};
    unseen_ = {};
    goal_ = guidance.goal;
    leg_.begin(guidance);
  } else if (leg_.routes.news(guidance) && way->kind != CueKind::slight) {
    reroute(*way, look, leg_);
  } else if (const auto turn = turn_within_reach(look); turn && way->fillings.hour == 12) {
    way = announce({CueKind::straight, About::then}, *way, *turn, look, leg_);
  }
  way->goes_on = true;
  way->priority = traits(CueKind::go_on).priority;
  leg_.heard(*bearing_.hour(), time);
  return {*way};
}

std::optional<Utterance> RouteCues::ask(const Guidance& guidance, double time) {
  const std::optional<Utterance> answer = direction(guidance, bearing_);
  if (answer) leg_.heard(*answer->fillings.hour, time);
  return answer;
}

std::optional<Utterance> RouteCues::order(const Guidance& guidance) const {
  std::optional<Utterance> way = direction(guidance, bearing_);
  if (!way) return std::nullopt;
  if (guidance.state == Guidance::State::make_room) {
    way->kind = CueKind::make_room;
    way->fillings.thing = guidance.blocked_by.value_or(ThingClass::other);
  } else if (way->kind == CueKind::straight && !guidance.waypoint_is_goal) {
    const Utterance turn = next_turn(guidance, rounding());
    if (turn.fillings.hour != 12) return turn;
  }
  return way;
}

void RouteCues::pause(bool goal_gone) {
  leg_.pause();
  bearing_.reset();
  if (goal_gone) goal_.reset();
}

void RouteCues::note(CueKind kind, CueStage stage) {
  if (!tells_sight(kind)) return;
  if (stage == CueStage::started)
    unseen_.before = std::exchange(unseen_.heard, kind == CueKind::toward_goal);
  if (stage == CueStage::cut) unseen_.heard = unseen_.before;
}

void RouteCues::lost(CueKind kind, double time) {
  if (is_way(family_of(kind))) leg_.lost(time);
  if (tells_route(kind)) leg_.route_lost(by_sound_);
  const bool last = tells_sight(kind) && unseen_.told == (kind == CueKind::toward_goal);
  if (last) unseen_.told = unseen_.heard;
}

bool RouteCues::is_new_goal(const Guidance& guidance) const {
  constexpr double kSameGoal = 0.5;  // m; a goal that moved less is the same goal.
  return !goal_ || (guidance.goal - *goal_).norm() > kSameGoal;
}

}  // namespace navvi_feedback::cues
