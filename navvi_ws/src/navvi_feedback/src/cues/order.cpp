#include "cues/order.hpp"

#include "cues/link_cues.hpp"

namespace navvi_feedback::cues {
namespace {

using navvi_types::Ask;

constexpr double kShown = 4.0;  // s

/// The robot cannot be driven.
std::optional<Utterance> undriveable(const Tick& tick, const HeldStick& held) {
  const Observation& now = tick.now;
  if (tick.links.simulator == Link::lost) return Utterance{lost_robot(now)};
  if (tick.links.pad == Link::lost) return Utterance{lost_stick(now)};
  if (held.needed() == CueKind::emergency_stop) return Utterance{CueKind::emergency_stop};
  if (now.gate == DriveState::State::stopped && !now.robotless)
    return Utterance{CueKind::robot_stopped};
  return std::nullopt;
}

/// As long as it is so.
std::optional<Utterance> lasting(const Tick& tick, const StateCues& state, const HeldStick& held,
                                 const Halt& halt, const RouteCues& route, bool leads) {
  const std::optional<Content> problem = state.problem();
  if (problem && problem != CueKind::blocked && problem != CueKind::welcome)
    return problem_words(*problem, tick.now);
  if (held.needed()) return Utterance{*held.needed()};
  // Without a goal nothing ends a wait; it is shown like what happens.
  const bool holds = !state.goal_gone() || (halt.told() && tick.time - *halt.told() < kShown);
  if (halt.halted() && holds) return halt.words();
  return leads ? route.order(*tick.now.guidance) : std::nullopt;
}

/// It asks for something else than what is shown.
bool replaces(Ask ask) { return ask != Ask::nothing && ask != Ask::beware && ask != Ask::ready; }

}  // namespace

void Order::note(const CueEvent& event, double time) {
  const navvi_types::Spoken* const spoken = event.spoken();
  if (!spoken || !spoken->lesson.empty()) return;
  const navvi_types::CueTraits& kind = traits(spoken->kind);
  if (event.stage == CueStage::started && kind.shown)
    event_ = Event{Utterance{*spoken}, event.text, time, event.id};
  else if (event.stage == CueStage::started && replaces(kind.ask))
    event_.reset();
  else if (event.stage == CueStage::cut && event_ && event.id == event_->id)
    event_.reset();
}

void Order::update(const Tick& tick, const StateCues& state, const HeldStick& held,
                   const Halt& halt, const RouteCues& route, bool leads,
                   const std::vector<Cue>& told) {
  for (const Cue& cue : told) {
    if (family_of(cue.kind) == Family::halt) event_.reset();
    if (traits(cue.kind).shown && cue.felt && !halt.halted())
      event_ = Event{Utterance{cue}, cue.text, tick.time};
  }
  if (event_ && tick.time - event_->time >= kShown) event_.reset();
  undriveable_ = undriveable(tick, held);
  lasting_ = lasting(tick, state, held, halt, route, leads);
  for (std::optional<Utterance>* const words : {&undriveable_, &lasting_})
    if (*words) (*words)->fillings.keys = tick.now.devices.keyboard;
}

}  // namespace navvi_feedback::cues
