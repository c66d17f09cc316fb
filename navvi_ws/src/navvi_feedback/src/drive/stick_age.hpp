#pragma once

#include <cmath>
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
  /// the last came 0.25 s ago, as a stick is lost that is silent for so long.
  [[nodiscard]] Late late(double time) const {
    if (time - time_ > 0.25) return Late::no;
    if (!(std::abs(age_) <= 1.0)) return Late::too_late;
    return age_ > 0.3 ? Late::slow : Late::no;
  }

 private:
  double age_ = 0.0;                                        ///< s, of the last message
  double time_ = -std::numeric_limits<double>::infinity();  ///< s, when it came
};

}  // namespace navvi_feedback::drive
