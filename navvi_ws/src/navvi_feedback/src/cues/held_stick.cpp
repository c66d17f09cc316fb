#include "cues/held_stick.hpp"

#include <cmath>

namespace navvi_feedback::cues {
namespace {

/// s; the gate opens a moment after the stick moves.
constexpr double kHold = 0.5;
/// s, between two requests.
constexpr double kRepeat = 2.5;
/// m/s and rad/s; a command below these is neutral.
constexpr double kNeutral = 0.02;

bool in_vain(const Observation& now) {
  if (now.stick_held_unarmed) return true;
  const bool shut =
      now.gate == DriveState::State::waiting || now.gate == DriveState::State::stopped;
  return shut &&
         (std::abs(now.commanded.linear) > kNeutral || std::abs(now.commanded.angular) > kNeutral);
}

}  // namespace

Utterances HeldStick::update(const Observation& now, double time) {
  if (!in_vain(now)) {
    since_.reset();
    return {};
  }
  if (!since_) since_ = time;
  if (time - *since_ < kHold || (said_ && time - *said_ < kRepeat)) return {};
  said_ = time;
  return {{CueKind::release_stick}};
}

}  // namespace navvi_feedback::cues
