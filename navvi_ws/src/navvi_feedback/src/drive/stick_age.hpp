#pragma once

#include <limits>

namespace navvi_feedback::drive {

/// The age of a stick's messages by their own stamps. Without a round trip a delay on the way and
/// clocks that differ look alike, so that either stops the robot.
class StickAge {
 public:
  enum class Late { no, slow, too_late };

  /// \param age  s, from the stamp to the arrival; negative where the stamp is ahead
  /// \param time  s, of the arrival, on a clock that does not run backwards
  void add(double age, double time) {
    age_ = age;
    time_ = time;
  }
  /// By the last message: above 0.3 s old is slow; above 1 s, or as much ahead, too late. no once
  /// the last came 0.25 s ago.
  [[nodiscard]] Late late(double time) const;

 private:
  double age_ = 0.0;                                        ///< s, of the last message
  double time_ = -std::numeric_limits<double>::infinity();  ///< s, when it came
};

}  // namespace navvi_feedback::drive
