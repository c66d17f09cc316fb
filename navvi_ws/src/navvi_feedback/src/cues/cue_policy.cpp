#include "cues/cue_policy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {
namespace {

void add(Utterances& told, const Utterances& more) {
  told.insert(told.end(), more.begin(), more.end());
}

/// A person stops for it, and then needs a direction.
bool makes_stop(const Utterance& utterance) {
  return utterance.fillings.side == Side::ahead || utterance.kind == CueKind::release_stick ||
         utterance.kind == CueKind::back_away || family_of(utterance.kind) == Family::stuck;
}

/// s, of standing before what does not move, where what leads all the time leads round it.
constexpr double kStood = 1.0;

bool is_fixed(const Utterance& utterance) {
  const auto thing = utterance.fillings.thing;
  return thing && (is_structure(*thing) || thing == ThingClass::box || thing == ThingClass::pedestal);
}

/// It says what HeldStick does, too.
bool tells_remedy(const Utterance& utterance) {
  return utterance.kind == CueKind::robot_stopped || utterance.kind == CueKind::emergency_stop ||
         utterance.kind == CueKind::pad_back ||
         Content(utterance) == Content(CueKind::back, About::keyboard);
}

}  // namespace

CuePolicy::CuePolicy(const CuePolicyConfig& config, Phrases phrases)
    : config_(config),
      links_(config.kPatience),
      notices_(config.kLastWords),
      stuck_(config),
      state_(config),
      near_(config.near),
      halt_(config.route.kRepeatDirection),
      route_(config.route),
      phrasing_(std::move(phrases), config.same_text) {}

std::vector<Cue> CuePolicy::update(const Observation& now, const Asked& asked, double time) {
  const Tick tick = look(now, asked, time);
  Utterances told = links_.update(now);
  add(told, notices_.update(tick, phrasing_));
  add(told, collisions_.update(now.contacts, time));
  add(told, release(tick, told));
  add(told, stuck_.update(now, tick.follows, time));
  add(told, state_.update(tick, halt_.told(), phrasing_));
  add(told, near(tick));
  remind(tick, told);
  const bool stops = halt(told, tick);
  Utterances answer = answers_.update(tick, route_, halt_, state_, held_);
  if (stops) answers_.yield(answer);
  if (!halt_.halted()) halt(answer, tick);
  const Utterances led = way(tick);
  if (!led.empty() && led.front().goes_on) answers_.yield(answer);
  add(told, answer);
  add(told, led);
  std::vector<Cue> cues = say(told, tick);
  order_.update(tick, state_, held_, halt_, route_, leads_, cues);
  return cues;
}

std::optional<Cue> CuePolicy::order() const {
  if (!order_.now()) return std::nullopt;
  const Utterance& words = *order_.now();
  return Cue{Content(words), order_.said().empty() ? phrasing_.shown(words) : order_.said(),
             traits(words.kind).priority};
}

Tick CuePolicy::look(const Observation& now, const Asked& asked, double time) {
  const Links& links = links_.judge(now, time);
  const bool follows = now.guidance && now.guidance->is_followed() &&
                       links.guidance == Link::alive && links.simulator != Link::lost &&
                       !awaited(now);
  return {now, asked, links, follows, time, links_.age(time)};
}

Utterances CuePolicy::release(const Tick& tick, const Utterances& told) {
  if (std::any_of(told.begin(), told.end(), tells_remedy)) held_.said(tick.time);
  // A person who has just arrived lets go of the stick anyway.
  const bool driven = tick.links.pad == Link::alive && tick.links.simulator == Link::alive &&
                      !awaited(tick.now) && state_.problem() != CueKind::arrived;
  return held_.update(tick.now, driven, tick.time);
}

Utterances CuePolicy::near(const Tick& tick) {
  // To a robot that stands without a way to go, what is near is no news, but what comes is.
  const std::optional<Velocity>& measured = tick.now.measured;
  const bool drives =
      measured && (std::abs(measured->linear) > kMoving || std::abs(measured->angular) > kMoving);
  const bool straight =
      config_.route.join && tick.time - phrasing_.straight_said() < config_.kRecover;
  const bool all = !lasts(tick.now.lead) && (tick.follows || drives);
  return near_.update(tick.now, all, {straight, halt_.fresh(tick.time)}, tick.time);
}

void CuePolicy::remind(const Tick& tick, const Utterances& told) {
  if (!tick.now.contacts.empty() || std::any_of(told.begin(), told.end(), makes_stop))
    route_.remind(tick.time + config_.kRecover);
}

/// A stop word, also in an answer, holds until "go on". \return whether one is said
bool CuePolicy::halt(const Utterances& told, const Tick& tick) {
  bool stops = false;
  for (const Utterance& utterance : told) {
    const bool said = utterance.asked || !phrasing_.too_soon(utterance, tick.time);
    if (family_of(utterance.kind) != Family::halt || !said) continue;
    // What leads all the time ends with a way that is blocked, and comes again with it.
    const bool shown = lasts(tick.now.lead) && utterance.kind == CueKind::blocked;
    if (shown && halt_.halted()) continue;
    halt_.say(utterance, tick.time);
    if (shown) halt_.end(tick.time);
    stops = stops || !shown;
  }
  return stops;
}

Utterances CuePolicy::way(const Tick& tick) {
  const bool just_over = notices_.trial_just_over(tick.time);
  // "Go on" is not contradicted while a person obeys it.
  const bool may_go = halt_.over(tick.now, tick.follows && links_.steered() && !just_over,
                                 near_.comes(tick.now, Halt::kObeyed), tick.time);
  if (just_over) return {};
  const bool blocked =
      state_.problem() == CueKind::blocked && tick.now.guidance && tick.now.guidance->leads();
  if (!links_.steered() || !(tick.follows || blocked)) {
    route_.pause(state_.goal_gone());
    return {};
  }
  // A wait that is not worth saying is no reason to say the direction again.
  if (!tick.follows && !halt_.halted()) return {};
  // Where the stick moves nothing, its remedy comes first.
  if (held_.needed()) return route_.update(tick.now, true, tick.time);
  // What leads all the time is "go on" itself.
  if (lasts(tick.now.lead)) {
    const bool stood = halt_.told() && tick.time - *halt_.told() > kStood;
    if (may_go || (stood && is_fixed(halt_.words()))) halt_.end(tick.time);
    return route_.update(tick.now, halt_.halted(), tick.time);
  }
  Utterances told = route_.update(tick.now, halt_.halted(), tick.time);
  const auto leads = [](const Utterance& one) { return is_way(family_of(one.kind)); };
  const bool led = std::any_of(told.begin(), told.end(), leads);
  if (!may_go && !(halt_.owes() && led)) return told;
  told.erase(std::remove_if(told.begin(), told.end(), leads), told.end());
  Utterances on = route_.go_on(tick.now, tick.time);
  add(on, told);
  return on;
}

std::vector<Cue> CuePolicy::say(const Utterances& told, const Tick& tick) {
  const std::vector<Cue> cues = phrasing_.cues_of(told, tick.now, tick.time);
  for (const Cue& cue : cues)
    if (cue.goes_on) halt_.release(cue.text);
  leads_ =
      tick.follows && tick.links.pad == Link::alive && !halt_.halted() && !notices_.trial_over();
  time_ = tick.time;
  return cues;
}

void CuePolicy::note(const std::vector<CueEvent>& events) {
  const auto replaced = [&](const CueEvent& gone) {
    return std::any_of(events.begin(), events.end(), [&](const CueEvent& event) {
      return event.stage == CueStage::queued && event.content() == gone.content() &&
             event.id > gone.id;
    });
  };
  for (const CueEvent& event : events) {
    if (event.stage == CueStage::started) {
      phrasing_.heard(event, time_);
      if (event.spoken()) answers_.heard(*event.spoken());
      if (event.kind() == CueKind::obstacle_comes) halt_.repeat(time_);
    }
    if (event.kind()) route_.note(*event.kind(), event.stage);
    order_.note(event, time_);
    const bool owed = halt_.owes() && !halt_.halted();
    halt_.note(event, replaced(event), time_);
    // "Go on" was not heard to its end.
    if (owed && halt_.halted()) lost(event);
  }
  for (const CueEvent& event : events) {
    const bool cut = event.stage == CueStage::cut && event.kind() && is_owed(*event.kind());
    if (cut || (event.stage == CueStage::dropped && !replaced(event))) lost(event);
  }
}

void CuePolicy::lost(const CueEvent& event) {
  const Content content = event.content().value_or(CueKind::lesson);
  phrasing_.forget(event);
  near_.unsaid(content);
  route_.lost(content.kind, time_);
  state_.lost(content, time_);
  answers_.lost(content);
}

}  // namespace navvi_feedback::cues
