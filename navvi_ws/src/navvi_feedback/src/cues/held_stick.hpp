#pragma once

#include <optional>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Says what to do while the stick is held and moves nothing: to release it, before it was neutral
/// for the first time, or since the robot was stopped; or to hold the button of hold-to-drive; or
/// that the emergency stop is pressed. A person cannot see that.
class HeldStick {
 public:
  /// \param driven  there is a stick, and a robot to be moved \param time  s, monotonic
  [[nodiscard]] Utterances update(const Observation& now, bool driven, double time);

  /// Another cue has just asked for the same.
  void said(double time) { said_ = time; }
  /// What the person has to do, as long as it is so; an emergency stop also with the stick at rest.
  [[nodiscard]] std::optional<CueKind> needed() const { return needed_; }

 private:
  std::optional<double> since_;   ///< s, held in vain
  std::optional<double> rested_;  ///< s, while the gate alone names the emergency stop
  std::optional<CueKind> needed_;
  std::optional<double> said_;  ///< s
};

}  // namespace navvi_feedback::cues
