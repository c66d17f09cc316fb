#include "cues/held_stick.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::cues {
namespace {

/// s; the gate opens a moment after the stick moves.
constexpr double kHold = 0.5;
/// s, between two requests.
constexpr double kRepeat = 2.5;
/// m/s and rad/s; a command below these is neutral.
constexpr double kNeutral = 0.02;

/// What a person has to do whose stick moves nothing.
std::optional<CueKind> remedy_of(const Observation& now) {
  // What is pressed must be released first.
  const Content pressed = CueKind::emergency_stop;
  if (std::count(now.notices.begin(), now.notices.end(), pressed) > 0) return {};
  if (now.stick_disabled) return CueKind::hold_to_drive;
  if (now.stick_held_unarmed) return CueKind::release_stick;
  const bool shut =
      now.gate == DriveState::State::waiting || now.gate == DriveState::State::stopped;
  const bool driven =
      std::abs(now.commanded.linear) > kNeutral || std::abs(now.commanded.angular) > kNeutral;
  return shut && driven ? std::optional(CueKind::release_stick) : std::nullopt;
}

}  // namespace

Utterances HeldStick::update(const Observation& now, double time) {
  const std::optional<CueKind> remedy = remedy_of(now);
  if (!remedy) {
    forget();
    return {};
  }
  if (!since_) since_ = time;
  if (time - *since_ < kHold) return {};
  needed_ = remedy;
  if (said_ && time - *said_ < kRepeat) return {};
  said_ = time;
  return {{*remedy}};
}

}  // namespace navvi_feedback::cues
