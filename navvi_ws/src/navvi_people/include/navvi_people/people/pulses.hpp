#pragma once

#include <optional>

#include "navvi_people/people/heard.hpp"
#include "navvi_people/people/tracking.hpp"

namespace navvi_people::people {

/// Reads pulses of the motors as the lesson on the way by hand teaches them: the side is where to
/// turn, weak or strong how far, both sides straight on; the quicker the pulses the faster to
/// drive; one side without a break: turn on the spot; no pulse: stand. Two hard motors are a
/// pattern, and no pulse of the way.
class Pulses {
 public:
  /// The motors, from now on.
  void feel(const Felt& felt, double time);
  /// What they ask for now; nullopt: to stand.
  [[nodiscard]] std::optional<Aim> update(double time);

 private:
  Felt last_;
  std::optional<double> begun_;  ///< s, of the last pulse
  bool on_ = false;
  bool pattern_ = false;         ///< the last pulse is part of one
  double interval_ = 0.0;        ///< s, between the last two; 0: there was one
  Aim aim_;
};

}  // namespace navvi_people::people
