#pragma once

#include <optional>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Says to release the stick while it is held and moves nothing: before it was neutral for the
/// first time, or since the robot was stopped. A person cannot see that it has to be let go.
class HeldStick {
 public:
  /// Call it while there is a stick, and a robot to be moved. \param time  s, monotonic
  [[nodiscard]] Utterances update(const Observation& now, double time);

  /// Another cue has just asked for the same.
  void said(double time) { said_ = time; }
  /// There is no stick, or nothing to be moved.
  void forget() { since_.reset(); }

 private:
  std::optional<double> since_;  ///< s, held in vain
  std::optional<double> said_;   ///< s
};

}  // namespace navvi_feedback::cues
