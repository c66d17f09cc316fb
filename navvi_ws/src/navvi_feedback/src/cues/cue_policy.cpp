#include "cues/cue_policy.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "cues/way_words.hpp"

namespace navvi_feedback::cues {
namespace {

/// s, from a collision or a stop to the next direction.
constexpr double kRecover = 2.0;
/// s, what a start may take before it is a problem.
constexpr double kStarting = 3.0;
/// s after the start, when a path may still be on its way.
constexpr double kFirstPath = 5.0;
/// s, without directions after the end of a trial: the session may be about to end, too.
constexpr double kLastWords = 10.0;
/// s, before a word to stop is followed by the word to wait.
constexpr double kStopped = 3.0;
/// s, from one word to the next on what a stick that is pushed waits for.
constexpr double kHeldBack = 2.5;
/// s; the same thing again within it is the same collision.
constexpr double kSameHit = 1.5;
/// m/s and rad/s; slower counts as standing.
constexpr double kMoving = 0.05;
/// s; what dies with the simulator may be missed by so much before it.
constexpr double kTogether = 0.3;

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
  }
  return CueKind::goal_refused_not_finite;
}

/// Why the guidance does not lead anywhere; nullopt if it does.
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

/// The act that a trial awaits before it begins; nullopt if none.
std::optional<CueKind> awaited(const Situation& now) {
  if (now.trial == TrialState::State::choose_goal) return CueKind::choose_goal;
  if (now.trial != TrialState::State::ready) return std::nullopt;
  return now.keyboard ? CueKind::press_enter : CueKind::press_start;
}

bool refused(std::optional<CueKind> problem) {
  return problem && family_of(*problem) == Family::refusal;
}

bool said_once(CueKind problem) {
  return problem == CueKind::arrived || problem == CueKind::welcome || refused(problem);
}

Fillings where(ThingClass thing, const Eigen::Vector2d& point) {
  return {{}, {}, thing, side_of(point)};
}

}  // namespace

CuePolicy::CuePolicy(const CuePolicyConfig& config, Phrases phrases)
    : config_(config),
      phrasing_(std::move(phrases), config.same_text),
      route_(config.route),
      near_(config.near),
      stuck_(config) {}

std::vector<Cue> CuePolicy::update(const Situation& now, double time) {
  const Links links = judge(now, time);
  follows_ = now.guidance && now.guidance->is_followed() && links.guidance == Link::alive &&
             links.simulator != Link::lost && !awaited(now);
  Utterances utterances;
  const auto add = [&](Utterances more) {
    utterances.insert(utterances.end(), more.begin(), more.end());
  };
  add(lost_and_found(now, links, time));
  add(collisions(now, time));
  add(release(now, links, time));
  if (const auto held = stuck_.update(now, follows_, time)) {
    route_.remind(time + kRecover);
    add({*held});
  }
  if (awaited_ && now.trial == TrialState::State::running) add({{CueKind::trial_begins}});
  awaited_ = awaited(now).has_value();
  add(guidance_state(now, links, time));
  add(near(now, time));
  Utterances answer = answers(now, time);
  halt(utterances, answer, time);
  const Utterances way = route(now, links, time);
  // That the wait is over is a better answer than why it was.
  const bool on = !way.empty() && way.front().goes_on;
  if (on && !answer.empty() && family_of(answer.front().kind) == Family::halt) {
    answer.clear();
    answered_.reset();
  }
  add(answer);
  add(way);
  const std::vector<Cue> cues = phrasing_.cues_of(utterances, now, time);
  for (const Cue& cue : cues)
    if (cue.goes_on) halt_.release(cue.text);
  leads_ = follows_ && links.pad == Link::alive && !halt_.halted() && !trial_over_;
  links_ = links;
  gate_ = now.gate;
  time_ = time;
  return cues;
}

/// Whoever hears a word to stop waits for "go on", be it an answer.
void CuePolicy::halt(const Utterances& told, const Utterances& answer, double time) {
  for (const Utterance& utterance : told)
    if (family_of(utterance.kind) == Family::halt && !phrasing_.too_soon(utterance.kind, time))
      halt_.say(utterance, time);
  for (const Utterance& utterance : answer)
    if (family_of(utterance.kind) == Family::halt && !halt_.halted()) halt_.say(utterance, time);
}

Links CuePolicy::judge(const Situation& now, double time) {
  if (!first_update_) first_update_ = time;
  const bool waited = time - *first_update_ > config_.patience;
  const auto judged = [&](Link link) { return link == Link::never && waited ? Link::lost : link; };
  const Links& links = now.links;
  if (links.proximity != Link::lost) sensed_ = time;
  const bool just_lost = links.proximity == Link::lost && time - sensed_ < kTogether;
  const Link near = just_lost ? Link::alive : judged(links.proximity);
  return {judged(links.pad), judged(links.simulator), near, judged(links.guidance), links.audio};
}

Utterances CuePolicy::lost_and_found(const Situation& now, const Links& links, double time) {
  Utterances told;
  const auto say = [&](CueKind kind) { told.push_back({kind}); };
  const auto lost = [&](Link Links::*link) {
    return links_.*link != Link::lost && links.*link == Link::lost;
  };
  const auto back = [&](Link Links::*link) {
    return links_.*link == Link::lost && links.*link == Link::alive;
  };
  const CueKind stick_back = now.keyboard ? CueKind::keyboard_back : CueKind::pad_back;
  if (lost(&Links::pad)) say(now.keyboard ? CueKind::keyboard_lost : CueKind::pad_lost);
  if (back(&Links::pad)) say(stick_back);
  if (lost(&Links::simulator)) say(CueKind::simulator_lost);
  if (back(&Links::audio)) say(CueKind::audio_back);
  // A loss that follows from that of the simulator or the pad has no cue of its own.
  const bool simulated = links.simulator != Link::lost;
  if (simulated && lost(&Links::proximity)) say(CueKind::proximity_lost);
  const bool stopped =
      gate_ == DriveState::State::running && now.gate == DriveState::State::stopped;
  if (simulated && stopped && links.pad != Link::lost) say(CueKind::robot_stopped);
  for (const Utterance& utterance : told)
    if (utterance.kind == stick_back || utterance.kind == CueKind::robot_stopped) held_.said(time);
  const std::set<CueKind> notices(now.notices.begin(), now.notices.end());
  for (const CueKind notice : notices) {
    if (noticed_.count(notice) > 0) continue;
    say(notice);
    told.back().fillings.person = now.person;
    if (family_of(notice) == Family::trial_end) trial_over_ = time;
  }
  noticed_ = notices;
  return told;
}

Utterances CuePolicy::collisions(const Situation& now, double time) {
  for (auto hit = hit_.begin(); hit != hit_.end();)
    hit = time - hit->second >= kSameHit ? hit_.erase(hit) : std::next(hit);
  Utterances told;
  for (const Contact& contact : now.contacts) {
    route_.remind(time + kRecover);
    if (!hit_.emplace(contact.id, time).second) continue;
    const CueKind kind = contact.thing_class == ThingClass::shelf  ? CueKind::collision_shelf
                         : contact.thing_class == ThingClass::wall ? CueKind::collision_wall
                                                                   : CueKind::collision_obstacle;
    told.push_back({kind, where(contact.thing_class, contact.seen_from_robot())});
  }
  return told;
}

Utterances CuePolicy::release(const Situation& now, const Links& links, double time) {
  // Who has just arrived lets go of the stick anyway.
  if (links.pad != Link::alive || links.simulator != Link::alive || awaited(now) ||
      problem_ == CueKind::arrived) {
    held_.forget();
    return {};
  }
  const auto request = held_.update(now, time);
  if (!request) return {};
  route_.remind(time + kRecover);
  return {*request};
}

Utterances CuePolicy::guidance_state(const Situation& now, const Links& links, double time) {
  if (links.simulator == Link::lost) return {};
  std::optional<CueKind> problem;
  if (links.guidance == Link::lost)
    problem = CueKind::guidance_lost;
  else if (now.guidance)
    problem = problem_of(*now.guidance);
  if (follows_) arrival_said_ = false;
  led_ = led_ || follows_;
  const bool idle = !problem || problem == CueKind::welcome || problem == CueKind::arrived;
  if (const auto wanted = awaited(now); idle && wanted) problem = wanted;

  const bool other_goal =
      refused(problem) && now.guidance && (now.guidance->goal - problem_goal_).norm() > 0.0;
  if (problem != problem_ || other_goal) {
    problem_ = problem;
    problem_since_ = time;
    problem_said_.reset();
    if (now.guidance) problem_goal_ = now.guidance->goal;
  }
  if (!problem_) return {};
  const bool at_once =
      problem_ == CueKind::arrived || problem_ == CueKind::guidance_lost || refused(problem_);
  const bool starting = problem_ == CueKind::welcome ||
                        (!led_ && (problem_ == CueKind::no_map || problem_ == CueKind::pose_stale));
  // Who was just told to stop need not be told to wait as well.
  const bool stopped = problem_ == CueKind::blocked && halt_.halted();
  const bool near =
      problem_ == CueKind::blocked && now.measured &&
      now.guidance->blocked_distance < now.measured->linear * config_.near.stop_moving;
  const double hold = at_once    ? 0.0
                      : stopped  ? kStopped
                      : near     ? 0.0
                      : starting ? kStarting
                                 : config_.state_hold;
  if (time - problem_since_ < hold) return {};
  const double pause = awaited_ && now.stick_held_unarmed ? kHeldBack : config_.problem_repeat;
  if (problem_said_ && (said_once(*problem_) || time - *problem_said_ < pause)) return {};
  // What is said too seldom for that is said a little later.
  if (phrasing_.too_soon(*problem_, time)) return {};
  problem_said_ = time;
  if (problem_ == CueKind::arrived && std::exchange(arrival_said_, true)) return {};
  return {tell_problem(*problem_, now)};
}

Utterance CuePolicy::tell_problem(CueKind kind, const Situation& now) const {
  Utterance told{kind};
  if (now.guidance) told.fillings.thing = now.guidance->blocked_by.value_or(ThingClass::other);
  return told;
}

Utterances CuePolicy::near(const Situation& now, double time) {
  // To a robot that stands without a way to go, what is near is no news, but what comes is.
  const bool drives = now.measured && (std::abs(now.measured->linear) > kMoving ||
                                       std::abs(now.measured->angular) > kMoving);
  const bool straight = config_.route.join && time - phrasing_.straight_said() < kRecover;
  Utterances told = near_.update(now, follows_ || drives, {straight, halt_.fresh(time)}, time);
  // A person stops for a thing ahead, and then needs a direction.
  for (const Utterance& utterance : told)
    if (utterance.fillings.side == Side::ahead) route_.remind(time + kRecover);
  return told;
}

Utterances CuePolicy::route(const Situation& now, const Links& links, double time) {
  // Without a stick no path can be followed. Its return is said first, then the direction.
  const bool steered = links.pad != Link::lost && links_.pad != Link::lost;
  const bool just_over = trial_over_ && time - *trial_over_ < kLastWords;
  // "Go on" is not contradicted while a person obeys it.
  const bool may_go =
      halt_.over(now, follows_ && steered && !just_over, near_.comes(now, Halt::kObeyed), time);
  if (just_over) return {};
  const bool leads = follows_ || (problem_ == CueKind::blocked && now.guidance->leads());
  if (leads && steered) {
    // A wait that is not worth saying is no reason to say the direction again.
    if (!follows_ && !halt_.halted()) return {};
    const Utterances way = route_.update(now, halt_.halted(), time);
    if (!may_go) return way;
    const auto on = route_.go_on(now, time);
    return on ? Utterances{*on} : Utterances{};
  }
  const bool goal_gone =
      problem_ == CueKind::arrived || problem_ == CueKind::welcome || refused(problem_);
  if (goal_gone)
    route_.forget();
  else
    route_.pause();
  return {};
}

/// All of it from the robot's nose, and as the crow flies.
Utterance CuePolicy::where_am_i(const Situation& now) const {
  Utterance told;
  if (now.place) {
    told.fillings.place = static_cast<PlaceName>(now.place->kind);
    told.fillings.number = static_cast<int>(now.place->number);
  }
  const bool goal = now.goal_angle && now.guidance && now.guidance->leads();
  if (goal) {
    told.fillings.distance = now.goal_straight;
    told.fillings.hour = clock_hour(*now.goal_angle, route_.rounding()).value_or(12);
  }
  told.kind = !goal ? CueKind::where_place : now.place ? CueKind::where : CueKind::where_goal;
  return told;
}

Utterances CuePolicy::answers(const Situation& now, double time) {
  if (now.menu) {
    Utterance label = *now.menu;
    label.asked = true;
    return {label};
  }
  // An answer that was dropped is made anew.
  const auto question = now.question ? now.question : std::exchange(question_, std::nullopt);
  if (!question) return {};
  asked_ = question;
  Utterance answer;
  const bool to_goal = follows_ && now.guidance->state == Guidance::State::following;
  if (question == Question::around) {
    answer = around(now.nearby);
  } else if (question == Question::help) {
    answer.kind = now.keyboard ? CueKind::help_keys : CueKind::help_pad;
  } else if (question == Question::where && (now.place || (to_goal && now.goal_angle))) {
    answer = where_am_i(now);
  } else if (to_goal && question == Question::turn && !now.guidance->waypoint_is_goal) {
    answer = next_turn(*now.guidance, route_.rounding());
  } else if (to_goal && question == Question::goal) {
    answer = goal_words(CueKind::goal_info, CueKind::goal_info_distance, now, route_.rounding());
  } else if (follows_ && halt_.halted()) {
    answer = halt_.words();
  } else if (const auto way = follows_ ? route_.ask(*now.guidance, time) : std::nullopt) {
    answer = *way;
    answer.goes_on = halt_.owes();
  } else {
    const bool no_goal = !problem_ || problem_ == CueKind::welcome;
    answer = tell_problem(no_goal ? CueKind::no_goal : *problem_, now);
    if (answer.kind == CueKind::no_goal && time - *first_update_ < kFirstPath) return {};
  }
  // An answer is wanted at once, whatever was said just before.
  answer.priority = Priority::message;
  answer.asked = true;
  answered_ = answer.kind;
  return {answer};
}

/// It was not heard.
void CuePolicy::forget(const CueEvent& event) {
  const CueKind kind = event.kind().value_or(CueKind::lesson);
  phrasing_.forget(event);
  near_.unsaid(kind);
  route_.lost(kind);
  if (kind == answered_) question_ = asked_;
}

void CuePolicy::note(const std::vector<CueEvent>& events) {
  const auto replaced = [&](std::optional<CueKind> kind) {
    return std::any_of(events.begin(), events.end(), [&](const CueEvent& event) {
      return event.stage == CueStage::queued && event.kind() == kind;
    });
  };
  for (const CueEvent& event : events) {
    if (event.stage == CueStage::started) {
      phrasing_.heard(event, time_);
      if (event.kind() == answered_) answered_.reset();
      if (event.kind() == CueKind::obstacle_comes) halt_.repeat(time_);
    }
    const bool owed = halt_.owes() && !halt_.halted();
    halt_.note(event, replaced(event.kind()), time_);
    // "Go on" was not heard to its end.
    if (owed && halt_.halted()) forget(event);
  }
  for (const CueEvent& event : events) {
    const bool cut = event.stage == CueStage::cut && event.kind() && tells_route(*event.kind());
    if (cut || (event.stage == CueStage::dropped && !replaced(event.kind()))) forget(event);
  }
}

}  // namespace navvi_feedback::cues
