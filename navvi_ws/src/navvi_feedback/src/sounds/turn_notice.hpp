#pragma once

#include <Eigen/Core>
#include <optional>

#include "navvi_feedback/sounds/earcon.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::sounds {

/// Announces a turn before it begins, where a sound leads that lasts: ticks from its side, one for
/// each 30 degrees.
class TurnNotice {
 public:
  /// Call it at 50 Hz. \param leads  the person is led along the way \param volume  gain
  /// \param time  s, of a clock that does not run backwards
  [[nodiscard]] std::optional<Play> update(const Observation& now, bool leads, double volume,
                                           double time);

 private:
  std::optional<Eigen::Vector2d> corner_;  ///< m, in map, that was announced last
  int left_ = 0;                           ///< ticks
  double side_ = 0.0;                      ///< 1 left, -1 right
  double last_ = 0.0;                      ///< s, of the last tick
};

}  // namespace navvi_feedback::sounds
