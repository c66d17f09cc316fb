#pragma once

#include <optional>

#include "navvi_feedback/drive/input_state.hpp"

namespace navvi_feedback::lessons {

/// A direction that the person points in with the stick: pushed out and held steady.
class Pointing {
 public:
  struct Direction {
    int degrees;    ///< counter-clockwise from straight ahead, left positive, (-180, 180]
    double pushed;  ///< s, when the stick was pushed out for it
  };

  /// \param time  s, of a clock that does not run backwards
  /// \return once a push, when it was held within 10 degrees for 0.5 s; nothing of a stick that was
  /// pushed before the first update, until it was at rest
  [[nodiscard]] std::optional<Direction> update(const drive::Stick& stick, double time);

 private:
  std::optional<double> pushed_;  ///< s, nullopt: the stick is at rest
  double angle_ = 0.0;            ///< rad, from which it may stray
  double since_ = 0.0;            ///< s, when it came to that angle
  bool taken_ = true;             ///< nothing more is taken until it is at rest
};

}  // namespace navvi_feedback::lessons
