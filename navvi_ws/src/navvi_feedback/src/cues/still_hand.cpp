#include "cues/still_hand.hpp"

#include <cmath>

namespace navvi_feedback::cues {
namespace {

/// s; a person who begins by themselves does so within that.
constexpr double kStill = 3.0;
/// m/s and rad/s; a command below these is neutral.
constexpr Velocity kNeutral{0.02, 0.05};

}  // namespace

void StillHand::observe(const Observation& now, double time) {
  const bool drives = std::abs(now.commanded.linear) > kNeutral.linear;
  const bool turns = std::abs(now.commanded.angular) > kNeutral.angular;
  driven = driven || drives;
  const bool in_vain = now.stick_held_unarmed || now.stick_disabled;  // HeldStick says what helps
  if (drives || turns || in_vain || now.voice_busy)
    since.reset();
  else if (!since)
    since = time;
}

bool StillHand::due(double time, double again) const {
  return !driven && since && time - *since >= kStill && !(urged && time - *urged < again);
}

}  // namespace navvi_feedback::cues
