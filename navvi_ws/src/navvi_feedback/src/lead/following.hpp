#pragma once

#include <navvi_types/motion.hpp>
#include <optional>

namespace navvi_feedback::lead {

/// Notices a person who does not follow a display that lasts, as if its sides were the wrong way
/// round or it were not perceived: turns away from it, or none where much is to be turned.
class Following {
 public:
  /// Call it at 50 Hz.
  /// \param off  rad, clockwise, from the nose to where to steer, while a course is shown
  /// \param motion  the robot's
  /// \param time  s, not going back
  void update(std::optional<double> off, const navvi_types::Velocity& motion, double time);
  /// False from the third such turn on.
  [[nodiscard]] bool follows() const { return missed_ < kMisses; }
  /// Another trial begins.
  void forgive() { *this = {}; }

 private:
  static constexpr int kMisses = 3;

  int missed_ = 0;
  double away_ = 0.0;            ///< rad, that it now turns to the other side
  std::optional<double> since_;  ///< s, much is to be turned
  double time_ = 0.0;            ///< s, of the last update
};

}  // namespace navvi_feedback::lead
