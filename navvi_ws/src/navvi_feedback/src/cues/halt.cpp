#include "cues/halt.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {
namespace {

/// s, for which the way must be clear.
constexpr double kClear = 0.8;
/// s, that a path leads; what is still there then must be driven round.
constexpr double kLongest = 8.0;
/// m, gap
constexpr double kAhead = 1.0;
/// rad; who turns by so much does not drive at what is ahead.
constexpr double kAside = 0.5;

bool clear(const Observation& now) {
  if (now.guidance && std::abs(now.guidance->steer_angle) > kAside) return true;
  return !anything_ahead(now.nearby, kAhead, true);
}

/// By their own hand; but back from what was hit is not on.
bool drives_on(const Observation& now) {
  const auto on = [](const Velocity& velocity) {
    return velocity.linear > kMoving || std::abs(velocity.angular) > kMoving;
  };
  return now.measured && on(*now.measured) && on(now.commanded);
}

}  // namespace

void Halt::say(const Utterance& words, double time) {
  if (state_ == State::free) heard_ = false;
  state_ = State::waiting;
  words_ = words;
  begun_ = false;
  said_ = last_ = time;
  clear_since_.reset();
}

void Halt::repeat(double time) {
  if (halted() && time - said_ < kLongest - kObeyed) last_ = time;
}

void Halt::release(const std::string& text) {
  if (state_ != State::released) before_ = state_;
  state_ = State::released;
  release_ = text;
  release_id_.reset();
}

void Halt::end(double time) {
  if (!halted()) return;
  state_ = State::told;
  last_ = time;
}

void Halt::note(const CueEvent& event, bool replaced, double time) {
  const bool stops = event.kind() && family_of(*event.kind()) == Family::halt;
  if (stops && event.stage == CueStage::queued) ++due_;
  if (stops && (event.stage == CueStage::started || event.stage == CueStage::dropped))
    due_ = std::max(0, due_ - 1);
  if (state_ == State::released && event.text == release_) {
    if (event.stage == CueStage::queued) release_id_ = event.id;
    if (event.id != release_id_) return;
    if (event.stage == CueStage::ended) {
      state_ = State::told;
      last_ = time;
    }
    if (event.stage == CueStage::cut || event.stage == CueStage::dropped) {
      state_ = before_;
      clear_since_.reset();
    }
    return;
  }
  if (!halted() || !stops) return;
  if (event.stage == CueStage::started) {
    heard_ = true;
    if (std::exchange(begun_, true))
      repeat(time);
    else
      said_ = last_ = time;
  }
  if (event.stage == CueStage::dropped && !replaced && !heard_ && due_ == 0) state_ = State::free;
}

bool Halt::over(const Observation& now, bool follows, bool comes, double time) {
  if (state_ == State::told && drives_on(now)) state_ = State::free;
  const bool awaits = halted() || state_ == State::told;
  led_since_ = since_when(awaits && follows, led_since_, time);
  const bool long_led = led_since_ && time - std::max(said_, *led_since_) > kLongest;
  const bool blind = now.links.proximity == Link::lost;
  const bool may_go = led_since_ && ((!blind && clear(now) && !comes) || long_led);
  clear_since_ = since_when(may_go, clear_since_, time);
  return may_go && time - last_ >= (halted() ? kObeyed : again_) && time - *clear_since_ >= kClear;
}

}  // namespace navvi_feedback::cues
