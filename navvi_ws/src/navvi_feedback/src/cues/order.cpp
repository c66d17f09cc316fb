#include "cues/order.hpp"

#include "cues/link_cues.hpp"
#include "cues/state_cues.hpp"

namespace navvi_feedback::cues {
namespace {

constexpr double kShown = 4.0;  // s

/// The robot cannot be driven.
std::optional<Utterance> undriveable(const Tick& tick) {
  const Observation& now = tick.now;
  if (tick.links.simulator == Link::lost) return Utterance{lost_robot(now)};
  if (tick.links.pad == Link::lost) return Utterance{lost_stick(now)};
  if (now.gate == DriveState::State::stopped && !now.robotless)
    return Utterance{CueKind::robot_stopped};
  return std::nullopt;
}

}  // namespace

void Order::update(const Tick& tick, const StateCues& state, const Halt& halt,
                   const RouteCues& route, bool leads, const std::vector<Cue>& told) {
  for (const Cue& cue : told) {
    if (family_of(cue.kind) == Family::halt) event_.reset();
    if (traits(cue.kind).shown) event_ = Event{{cue.kind}, cue.text, tick.time};
  }
  if (event_ && tick.time - event_->time >= kShown) event_.reset();
  const std::optional<CueKind> problem = state.problem();
  said_.clear();
  now_ = undriveable(tick);
  if (!now_ && event_) {
    now_ = event_->words;
    said_ = event_->text;
  }
  if (!now_ && problem && problem != CueKind::blocked && problem != CueKind::welcome)
    now_ = problem_words(*problem, tick.now);
  if (!now_ && halt.halted()) now_ = halt.words();
  if (!now_ && leads) now_ = route.order(*tick.now.guidance);
  if (now_) now_->fillings.keys = tick.now.devices.keyboard;
}

}  // namespace navvi_feedback::cues
