#include "cues/state_cues.hpp"

#include <utility>

namespace navvi_feedback::cues {
namespace {

/// The reason of a refusal, or the state, where these have the words of what is said.
template <typename Reason>
Content because(CueKind kind, Reason reason) {
  return {kind, navvi_types::from_word<About>(to_string(reason)).value()};
}

/// s; a state of the guidance that is shorter is passed over, but not a wait that is near.
constexpr double kHold = 0.5;
/// s, before a word to stop is followed by the word to wait.
constexpr double kStopped = 3.0;
/// s, of standing, before words say why.
constexpr double kWhy = 1.0;
/// s, from one word to the next on what a stick that is pushed waits for.
constexpr double kHeldBack = 2.5;

bool said_once(const std::optional<Content>& problem) {
  return problem == CueKind::arrived || problem == CueKind::welcome ||
         problem == CueKind::goal_refused;
}

}  // namespace

std::optional<Content> problem_of(const Guidance& guidance) {
  switch (guidance.state) {
    case Guidance::State::no_goal:
      return CueKind::welcome;
    case Guidance::State::following:
    case Guidance::State::make_room:
      return std::nullopt;
    case Guidance::State::goal_refused:
      if (guidance.refusal != Guidance::Refusal::none)
        return because(CueKind::goal_refused, guidance.refusal);
      return Content(CueKind::goal_refused, About::not_finite);
    case Guidance::State::arrived:
      return CueKind::arrived;
    case Guidance::State::blocked:
      return CueKind::blocked;
    case Guidance::State::off_mesh:
      return CueKind::off_mesh;
    case Guidance::State::no_route:
    case Guidance::State::no_map:
    case Guidance::State::map_stale:
    case Guidance::State::pose_stale:
      return because(CueKind::no_way, guidance.state);
  }
  return std::nullopt;
}

Utterance problem_words(const Content& problem, const Observation& now) {
  Utterance told{problem};
  if (now.guidance) told.fillings.thing = now.guidance->blocked_by.value_or(ThingClass::other);
  if (problem == CueKind::press) told.fillings.place_name = now.reached;
  return told;
}

Utterances StateCues::update(const Tick& tick, std::optional<double> halted,
                             const Phrasing& phrasing) {
  Utterances told;
  const bool wanted = std::exchange(awaited_, awaited(tick.now).has_value());
  if (wanted && tick.now.trial == TrialState::State::running) {
    told = {{CueKind::trial_begins}};
    told.front().asked = true;  // by the press, which what asked for it is not to delay
    arrival_said_ = false;
  }
  if (tick.links.simulator == Link::lost) return told;
  observe(tick);
  // What is said too seldom for now is said a little later.
  if (!problem_ || !due(tick, halted) || phrasing.too_soon(*problem_, tick.time)) return told;
  said_ = tick.time;
  lost_.reset();
  const bool again = problem_ == CueKind::arrived && std::exchange(arrival_said_, true);
  if (!again) told.push_back(problem_words(*problem_, tick.now));
  return told;
}

void StateCues::lost(const Content& content, double time) {
  if (problem_ != content) return;
  lost_ = time;
  arrival_said_ = false;
}

bool StateCues::goal_gone() const { return said_once(problem_); }

std::optional<Content> StateCues::judge(const Tick& tick) const {
  std::optional<Content> problem;
  if (tick.links.guidance == Link::lost)
    problem = CueKind::guidance_lost;
  else if (tick.now.guidance)
    problem = problem_of(*tick.now.guidance);
  const bool idle = !problem || problem == CueKind::welcome || problem == CueKind::arrived;
  const std::optional<Content> wanted = awaited(tick.now);
  return idle && wanted ? wanted : problem;
}

void StateCues::observe(const Tick& tick) {
  if (tick.follows) arrival_said_ = false;
  led_ = led_ || tick.follows;
  const std::optional<Content> problem = judge(tick);
  const std::optional<Guidance>& guidance = tick.now.guidance;
  const bool other_goal =
      problem == CueKind::goal_refused && guidance && (guidance->goal - goal_).norm() > 0.0;
  if (problem == problem_ && !other_goal) return;
  problem_ = problem;
  since_ = tick.time;
  said_.reset();
  lost_.reset();
  if (guidance) goal_ = guidance->goal;
}

bool StateCues::due(const Tick& tick, std::optional<double> halted) const {
  if (tick.time - since_ < hold(tick, halted)) return false;
  // Who is in the menu is about to do what is awaited.
  if (awaited_ && tick.now.menu_open) return false;
  if (lost_) return tick.time - *lost_ >= kTryAgain;
  const bool pushed = awaited_ && tick.now.stick_held_unarmed;
  const double pause = pushed ? kHeldBack : config_.kProblemRepeat;
  return !said_ || (!said_once(problem_) && tick.time - *said_ >= pause);
}

/// s, for which it must last.
double StateCues::hold(const Tick& tick, std::optional<double> halted) const {
  if (problem_ == CueKind::arrived || problem_ == CueKind::guidance_lost ||
      problem_ == CueKind::goal_refused)
    return 0.0;
  // The end of what leads has stopped the person; the words are why.
  if (problem_ == CueKind::blocked && lasts(tick.now.lead)) return kWhy;
  if (problem_ == CueKind::blocked) {
    // Who was just told to stop need not be told to wait as well.
    if (halted && since_ - *halted < kStopped) return kStopped;
    const bool near = tick.now.measured && tick.now.guidance->blocked_distance <
                                               tick.now.measured->linear * config_.near.stop_moving;
    if (near) return 0.0;
  }
  const bool starting = problem_ == CueKind::welcome ||
                        (!led_ && (problem_ == Content{CueKind::no_way, About::no_map} ||
                                   problem_ == Content{CueKind::no_way, About::pose_stale}));
  return starting ? config_.kStarting : kHold;
}

}  // namespace navvi_feedback::cues
