#include "cues/cue_policy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cues/clock_face.hpp"

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
/// m; what is less far ahead is beside.
constexpr double kBeside = 0.05;

/// Why the guidance does not lead anywhere, as a kind of cue; empty if it does.
std::string problem_of(const Guidance& guidance) {
  const bool unexplained = guidance.refusal == Guidance::Refusal::none;
  const auto refusal = unexplained ? Guidance::Refusal::not_finite : guidance.refusal;
  switch (guidance.state) {
    case Guidance::State::no_goal:
      return "welcome";
    case Guidance::State::following:
    case Guidance::State::make_room:
      return "";
    case Guidance::State::goal_refused:
      return std::string("goal_refused_") + to_string(refusal);
    default:  // the kind has the name of the state
      return to_string(guidance.state);
  }
}

/// What is awaited before a trial begins, as a kind of cue; empty if nothing is.
std::string awaited(const Situation& now) {
  if (now.trial == TrialState::State::choose_goal) return "choose_goal";
  if (now.trial != TrialState::State::ready) return "";
  return now.keyboard ? "press_enter" : "press_start";
}

/// Words that depend on where the robot is.
bool leads_the_way(const std::string& kind) {
  static const std::set<std::string> kinds = {
      "direction",      "straight", "slight",    "straight_then",    "turn_ahead", "turn_now",
      "turn_cancelled", "rerouted", "make_room", "rerouted_blocked", "wrong_way",  "off_path"};
  return kinds.count(kind) > 0;
}

bool refused(const std::string& problem) { return problem.rfind("goal_refused", 0) == 0; }

bool said_once(const std::string& problem) {
  return problem == "arrived" || problem == "welcome" || refused(problem);
}

/// Words to stop, until it is said to go on.
bool halts(const std::string& kind) { return kind == "blocked" || kind == "obstacle_stop"; }

bool moves(const Utterance& told) {
  const ThingClass thing = told.fillings.thing.value_or(ThingClass::other);
  return thing == ThingClass::worker || thing == ThingClass::forklift ||
         thing == ThingClass::pallet_robot;
}

/// Its words are a reminder: each of the others is for something that has just happened, be it the
/// same thing that is hit or waited for once more.
bool tells_nothing_new(const Utterance& utterance) {
  static const std::set<std::string> reminders = {"stuck",         "stuck_unknown", "back_away",
                                                  "release_stick", "press_start",   "press_enter",
                                                  "choose_goal"};
  const Priority priority = utterance.priority.value_or(cue_kind(utterance.kind).priority);
  const bool introduces = utterance.kind.rfind("start", 0) == 0;
  return (priority <= Priority::text && !introduces) || reminders.count(utterance.kind) > 0;
}

/// Whether the person does without it, unless they ask.
bool muted(const std::string& kind, const WordingConfig& wording) {
  static const std::set<std::string> way = {"direction",     "straight",   "slight",
                                            "straight_then", "turn_ahead", "turn_cancelled"};
  static const std::set<std::string> near = {"shelf_near", "wall_near",     "shelf_close",
                                             "wall_close", "obstacle_near", "obstacle_close"};
  return (!wording.way && way.count(kind) > 0) || (!wording.near && near.count(kind) > 0);
}

/// rad, clockwise from the nose
double angle_of(int hour) { return hour * kHourDegrees * M_PI / 180.0; }

/// Whether a robot that turned there could drive on.
bool is_free(int hour, const std::vector<NearThing>& nearby, double gap) {
  const double angle = angle_of(hour);
  const Eigen::Vector2d way(std::cos(angle), -std::sin(angle));
  return std::none_of(nearby.begin(), nearby.end(), [&](const NearThing& thing) {
    const Eigen::Vector2d& at = thing.nearest;
    const double across = way.x() * at.y() - way.y() * at.x();
    return thing.gap <= gap && way.dot(at) > kBeside && std::abs(across) <= kHalfLane;
  });
}

Fillings where(ThingClass thing, const Eigen::Vector2d& point) {
  return {{}, {}, thing, side_of(point)};
}

}  // namespace

CuePolicy::CuePolicy(const CuePolicyConfig& config, Phrases phrases)
    : config_(config), phrases_(std::move(phrases)), route_(config.route), near_(config.near) {}

void CuePolicy::use(const WordingConfig& wording) {
  config_.wording = wording;
  phrases_.use(wording);
}

std::vector<Cue> CuePolicy::update(const Situation& now, double time) {
  const Links links = judge(now, time);
  follows_ = now.guidance && now.guidance->is_followed() && links.guidance == Link::alive &&
             links.simulator != Link::lost && awaited(now).empty();
  Utterances utterances;
  const auto add = [&](Utterances more) {
    utterances.insert(utterances.end(), more.begin(), more.end());
  };
  add(lost_and_found(now, links, time));
  add(collisions(now, time));
  add(release(now, links, time));
  add(stuck(now, time));
  if (awaited_ && now.trial == TrialState::State::running) add({{"trial_begins"}});
  awaited_ = !awaited(now).empty();
  add(guidance_state(now, links, time));
  add(near(now, time));
  const Utterances answer = answers(now, time);
  for (const Utterance& utterance : utterances)
    if (halts(utterance.kind)) halt_.say(utterance, time);
  add(answer);
  add(route(now, links, time));
  leads_ = follows_ && links.pad == Link::alive && !halt_.halted() && !trial_over_;
  links_ = links;
  gate_ = now.gate;
  time_ = time;
  return phrase(utterances, now, time);
}

Links CuePolicy::judge(const Situation& now, double time) {
  if (!first_update_) first_update_ = time;
  const bool waited = time - *first_update_ > config_.patience;
  const auto judged = [&](Link link) { return link == Link::never && waited ? Link::lost : link; };
  const Links& links = now.links;
  return {judged(links.pad), judged(links.simulator), judged(links.proximity),
          judged(links.guidance), links.audio};
}

CuePolicy::Utterances CuePolicy::lost_and_found(const Situation& now, const Links& links,
                                                double time) {
  Utterances told;
  const auto say = [&](const std::string& kind) { told.push_back({kind}); };
  const auto lost = [&](Link Links::*link) {
    return links_.*link != Link::lost && links.*link == Link::lost;
  };
  const auto back = [&](Link Links::*link) {
    return links_.*link == Link::lost && links.*link == Link::alive;
  };
  const std::string stick = now.keyboard ? "keyboard" : "pad";
  if (lost(&Links::pad)) say(stick + "_lost");
  if (back(&Links::pad)) say(stick + "_back");
  if (lost(&Links::simulator)) say("simulator_lost");
  if (back(&Links::audio)) say("audio_back");
  // A loss that follows from that of the simulator or the pad has no cue of its own.
  const bool simulated = links.simulator != Link::lost;
  if (simulated && lost(&Links::proximity)) say("proximity_lost");
  const bool stopped =
      gate_ == DriveState::State::running && now.gate == DriveState::State::stopped;
  if (simulated && stopped && links.pad != Link::lost) say("robot_stopped");
  for (const Utterance& utterance : told)
    if (utterance.kind == stick + "_back" || utterance.kind == "robot_stopped") held_.said(time);
  const std::set<std::string> notices(now.notices.begin(), now.notices.end());
  for (const std::string& notice : notices) {
    if (noticed_.count(notice) > 0) continue;
    say(notice);
    told.back().fillings.person = now.person;
    if (notice.rfind("trial_", 0) == 0) trial_over_ = time;
  }
  noticed_ = notices;
  return told;
}

CuePolicy::Utterances CuePolicy::collisions(const Situation& now, double time) {
  for (auto hit = hit_.begin(); hit != hit_.end();)
    hit = time - hit->second >= kSameHit ? hit_.erase(hit) : std::next(hit);
  Utterances told;
  for (const Contact& contact : now.contacts) {
    route_.remind(time + kRecover);
    if (!hit_.emplace(contact.id, time).second) continue;
    const std::string kind = contact.thing_class == ThingClass::shelf  ? "collision_shelf"
                             : contact.thing_class == ThingClass::wall ? "collision_wall"
                                                                       : "collision_obstacle";
    told.push_back({kind, where(contact.thing_class, contact.seen_from_robot())});
  }
  return told;
}

CuePolicy::Utterances CuePolicy::release(const Situation& now, const Links& links, double time) {
  if (links.pad != Link::alive || links.simulator != Link::alive || !awaited(now).empty()) {
    held_.forget();
    return {};
  }
  const auto request = held_.update(now, time);
  if (!request) return {};
  route_.remind(time + kRecover);
  return {*request};
}

CuePolicy::Utterances CuePolicy::stuck(const Situation& now, double time) {
  // Commands near the thresholds may well move the robot more slowly than these.
  const bool commanded = std::abs(now.commanded.linear) > 2.0 * config_.stuck_linear ||
                         std::abs(now.commanded.angular) > 2.0 * config_.stuck_angular;
  const bool still = now.measured && std::abs(now.measured->linear) < config_.stuck_linear &&
                     std::abs(now.measured->angular) < config_.stuck_angular;
  const bool held =
      now.gate == DriveState::State::stopped || now.gate == DriveState::State::waiting;
  if (!commanded || !still || held) {
    blocked_since_.reset();
    stuck_said_.reset();
    return {};
  }
  if (!blocked_since_) blocked_since_ = time;
  if (time - *blocked_since_ <= config_.stuck_time) return {};
  if (stuck_said_ && time - *stuck_said_ < config_.stuck_repeat) return {};
  stuck_said_ = time;
  route_.remind(time + kRecover);

  // What lies where the person wants to go blocks more than what is merely nearer.
  const NearThing* blocker = nullptr;
  const auto rank = [&](const NearThing& thing) {
    const bool in_the_way = thing.nearest.x() * now.commanded.linear >= 0.0;
    return std::make_pair(in_the_way ? 0 : 1, thing.gap);
  };
  for (const NearThing& thing : now.nearby)
    if (thing.gap <= config_.blocker_gap && (!blocker || rank(thing) < rank(*blocker)))
      blocker = &thing;
  if (!blocker) return {{"stuck_unknown"}};
  Fillings fillings = where(blocker->thing_class, blocker->nearest);
  const auto free = [&](int hour) { return is_free(hour, now.nearby, config_.blocker_gap); };
  if (fillings.side == Side::ahead && free(6)) return {{"back_away", fillings}};
  const double wanted = follows_ ? now.guidance->steer_angle : 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int hour = 1; hour <= 12; ++hour) {
    const double aside = std::abs(std::remainder(angle_of(hour) - wanted, 2.0 * M_PI));
    if (aside >= least || !free(hour)) continue;
    least = aside;
    fillings.hour = hour;
  }
  if (fillings.hour) return {{"stuck", fillings}};
  Utterance boxed_in{"stuck_unknown"};
  const Utterance sides = around(now.nearby);
  boxed_in.also = sides.also;
  boxed_in.also.insert(boxed_in.also.begin(), sides);
  for (Utterance& side : boxed_in.also) side.from.reset();  // words alone are sooner over
  return {boxed_in};
}

CuePolicy::Utterances CuePolicy::guidance_state(const Situation& now, const Links& links,
                                                double time) {
  if (links.simulator == Link::lost) return {};
  std::string problem;
  if (links.guidance == Link::lost)
    problem = "guidance_lost";
  else if (now.guidance)
    problem = problem_of(*now.guidance);
  if (follows_) arrival_said_ = false;
  led_ = led_ || follows_;
  const bool idle = problem.empty() || problem == "welcome" || problem == "arrived";
  if (const std::string wanted = awaited(now); idle && !wanted.empty()) problem = wanted;

  const bool other_goal =
      refused(problem) && now.guidance && (now.guidance->goal - problem_goal_).norm() > 0.0;
  if (problem != problem_ || other_goal) {
    problem_ = problem;
    problem_since_ = time;
    problem_said_.reset();
    if (now.guidance) problem_goal_ = now.guidance->goal;
  }
  if (problem_.empty()) return {};
  const bool at_once = problem_ == "arrived" || problem_ == "guidance_lost" || refused(problem_);
  const bool starting =
      problem_ == "welcome" || (!led_ && (problem_ == "no_map" || problem_ == "pose_stale"));
  // Who was just told to stop need not be told to wait as well.
  const bool stopped = problem_ == "blocked" && halt_.halted();
  const bool near =
      problem_ == "blocked" && now.measured &&
      now.guidance->blocked_distance < now.measured->linear * config_.near.stop_moving;
  const double hold = at_once    ? 0.0
                      : stopped  ? kStopped
                      : near     ? 0.0
                      : starting ? kStarting
                                 : config_.state_hold;
  if (time - problem_since_ < hold) return {};
  const double pause = awaited_ && now.stick_held_unarmed ? kHeldBack : config_.problem_repeat;
  if (problem_said_ && (said_once(problem_) || time - *problem_said_ < pause)) return {};
  // What is said too seldom for that is said a little later.
  if (too_soon(cue_kind(problem_), time)) return {};
  problem_said_ = time;
  if (problem_ == "arrived" && std::exchange(arrival_said_, true)) return {};
  return {tell_problem(now)};
}

Utterance CuePolicy::tell_problem(const Situation& now) const {
  Utterance told{problem_};
  if (now.guidance) told.fillings.thing = now.guidance->blocked_by.value_or(ThingClass::other);
  return told;
}

CuePolicy::Utterances CuePolicy::near(const Situation& now, double time) {
  // To a robot that stands without a way to go, what is near is no news, but what comes is.
  const bool drives = now.measured && (std::abs(now.measured->linear) > kMoving ||
                                       std::abs(now.measured->angular) > kMoving);
  const bool straight = config_.route.join && time - straight_said_ < kRecover;
  Utterances told = near_.update(now, follows_ || drives, {straight, halt_.fresh(time)}, time);
  // A person stops for a thing ahead, and then needs a direction.
  for (const Utterance& utterance : told)
    if (utterance.fillings.side == Side::ahead) route_.remind(time + kRecover);
  return told;
}

CuePolicy::Utterances CuePolicy::route(const Situation& now, const Links& links, double time) {
  if (trial_over_ && time - *trial_over_ < kLastWords) return {};
  // Without a stick no path can be followed. Its return is said first, then the direction.
  const bool steered = links.pad != Link::lost && links_.pad != Link::lost;
  const bool leads = follows_ || (problem_ == "blocked" && now.guidance->leads());
  if (leads && steered) {
    const bool halted = halt_.update(now, follows_, time);
    // A wait that is not worth saying is no reason to say the direction again.
    if (!follows_ && !halted) return {};
    const Utterances way = route_.update(now, halted, time);
    // What stands there still does: "go on" comes with the way past it.
    if (halted && halt_.words().kind == "obstacle_stop" && !moves(halt_.words())) route_.unsaid();
    if (way.empty() && now.voice_busy && now.sounds.turn) return {};
    return halt_.go_on(way, now.sounds.turn, time);
  }
  halt_.forget();
  const bool goal_gone = problem_ == "arrived" || problem_ == "welcome" || refused(problem_);
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
    told.fillings.hour = route_.hour_of(*now.goal_angle);
  }
  told.kind = !goal ? "where_place" : now.place ? "where" : "where_goal";
  return told;
}

CuePolicy::Utterances CuePolicy::answers(const Situation& now, double time) {
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
    answer.kind = now.keyboard ? "help_keys" : "help_pad";
  } else if (question == Question::where && (now.place || (to_goal && now.goal_angle))) {
    answer = where_am_i(now);
  } else if (to_goal && question == Question::turn && !now.guidance->waypoint_is_goal) {
    answer = route_.next_turn(*now.guidance);
  } else if (to_goal && question == Question::goal) {
    answer = route_.goal("goal_info", now);
  } else if (follows_ && halt_.halted()) {
    answer = halt_.words();
  } else if (const auto way = follows_ ? route_.ask(*now.guidance, time) : std::nullopt) {
    answer = *way;
  } else {
    answer = tell_problem(now);
    if (problem_.empty() || problem_ == "welcome") answer.kind = "no_goal";
    if (answer.kind == "no_goal" && time - *first_update_ < kFirstPath) return {};
  }
  // An answer is wanted at once, whatever was said just before.
  answer.priority = Priority::message;
  answer.asked = true;
  answered_ = answer.kind;
  return {answer};
}

bool CuePolicy::too_soon(const CueKind& kind, double time) const {
  const auto last = last_said_.find(kind.kind);
  return last != last_said_.end() && time - last->second < kind.min_interval;
}

/// As much of it as may be spoken at once.
CuePolicy::Sentence CuePolicy::word(const Utterance& utterance, bool again) const {
  Sentence told{phrases_.say(utterance.kind, utterance.fillings, again), {}};
  const auto longer = [&](const std::string& joined) {
    const bool fits = speakable(joined);
    if (fits) told.text = joined;
    return fits;
  };
  const auto sounds_from = [&](const Utterance& part) {
    if (part.from)
      told.scan.push_back({earcon_of(part.fillings.thing.value_or(ThingClass::other)), *part.from});
  };
  sounds_from(utterance);
  if (utterance.goes_on) longer(phrases_.say("go_on") + ", " + told.text);
  for (const Utterance& more : utterance.also)
    if (longer(told.text + ", " + phrases_.say(more.kind, more.fillings))) sounds_from(more);
  return told;
}

std::vector<Cue> CuePolicy::phrase(const Utterances& utterances, const Situation& now,
                                   double time) {
  std::vector<Cue> cues;
  for (const Utterance& utterance : utterances) {
    const CueKind& kind = cue_kind(utterance.kind);
    if (!utterance.asked && muted(kind.kind, config_.wording) && !instead_of(utterance, now.sounds))
      continue;
    if (!utterance.asked && too_soon(kind, time)) continue;
    const auto age = [&](const std::string& text) {
      const auto same = last_text_.find(text);
      return same == last_text_.end() ? std::numeric_limits<double>::infinity()
                                      : time - same->second;
    };
    const auto sound = instead_of(utterance, now.sounds);
    Sentence told = word(utterance, false);
    const bool again = !utterance.asked && !sound && age(told.text) < config_.same_text;
    const bool felt = again && now.touch && tells_nothing_new(utterance);
    if (again && !felt)
      if (Sentence other = word(utterance, true); age(other.text) > age(told.text)) told = other;
    Cue cue{kind.kind,    told.text, utterance.priority.value_or(kind.priority),
            kind.max_age, sound,     utterance.asked};
    cue.felt = felt;
    cue.scan = told.scan;
    if (!sound && !felt) {
      last_text_[cue.text] = time;
      if (utterance.fillings.hour == 12) straight_said_ = time;
    }
    last_said_[kind.kind] = time;
    cues.push_back(cue);
  }
  std::stable_sort(cues.begin(), cues.end(),
                   [](const Cue& a, const Cue& b) { return a.priority > b.priority; });
  return cues;
}

/// It was not heard.
void CuePolicy::forget(const CueEvent& event) {
  last_said_.erase(event.kind);
  last_text_.erase(event.text);
  near_.unsaid(event.kind);
  if (leads_the_way(event.kind)) route_.unsaid();
  if (event.kind == answered_) question_ = asked_;
}

void CuePolicy::note(const std::vector<CueEvent>& events) {
  const auto replaced = [&](const std::string& kind) {
    return std::any_of(events.begin(), events.end(), [&](const CueEvent& event) {
      return event.stage == CueStage::queued && event.kind == kind;
    });
  };
  for (const CueEvent& event : events) {
    if (event.stage == CueStage::started) {
      last_text_[event.text] = time_;
      if (event.kind == answered_) answered_.clear();
    }
    if (!halts(event.kind)) continue;
    if (event.stage == CueStage::started) halt_.heard(time_);
    if (event.stage == CueStage::dropped && !replaced(event.kind)) halt_.not_heard();
  }
  for (const CueEvent& event : events)
    if (event.stage == CueStage::dropped && !replaced(event.kind)) forget(event);
}

}  // namespace navvi_feedback::cues
