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
  if (now.stick_disabled) return CueKind::hold_to_drive;
  if (now.stick_held_unarmed) return CueKind::release_stick;
  const bool shut =
      now.gate == DriveState::State::waiting || now.gate == DriveState::State::stopped;
  const bool driven =
      std::abs(now.commanded.linear) > kNeutral || std::abs(now.commanded.angular) > kNeutral;
  return shut && driven ? std::optional(CueKind::release_stick) : std::nullopt;
}

}  // namespace

Utterances HeldStick::update(const Observation& now, bool driven, double time) {
  constexpr double kOpens = 1.0;  // s, and a round trip, until a gate has opened to a stick at rest
  const auto names_stop = [](const std::vector<Content>& states) {
    return std::count(states.begin(), states.end(), CueKind::emergency_stop) > 0;
  };
  const std::optional<CueKind> remedy = driven ? remedy_of(now) : std::nullopt;
  since_ = since_when(remedy.has_value(), since_, time);
  const bool held = since_ && time - *since_ >= kHold;
  // What is pressed must be released first. The gate names it until the stick has been at rest: to
  // a held one that may be all that is left of it, unless the gate just stayed shut to one at rest.
  const bool told = names_stop(now.devices.states), named = names_stop(now.notices);
  const bool shut = rested_ && time - *rested_ > kOpens + now.connection.round_trip;
  const bool still = named && (!remedy || (shut && time - *since_ <= 3.0 * kRepeat));
  rested_ = since_when(driven && still && !told, rested_, time);
  needed_ = (told || still) && !now.robotless ? std::optional(CueKind::emergency_stop)
            : held                            ? remedy
                                              : std::nullopt;
  if (!held || (said_ && time - *said_ < kRepeat)) return {};
  said_ = time;
  return {{*needed_}};
}

}  // namespace navvi_feedback::cues
