#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace navvi_nav {

/// How fast somebody drives when they do: forward speed with a time constant of 10 s, over the
/// times when the robot moved.
class Pace {
 public:
  void update(double time, double speed) {
    const double elapsed = last_ ? std::clamp(time - *last_, 0.0, 1.0) : 0.0;
    last_ = time;
    if (speed > kMoving) pace_ += (speed - pace_) * (1.0 - std::exp(-elapsed / kMemory));
  }
  [[nodiscard]] double value() const { return pace_; }  ///< m/s, > 0

 private:
  static constexpr double kMoving = 0.1;   // m/s
  static constexpr double kMemory = 10.0;  // s
  double pace_ = 0.7;                      // m/s, before anybody drove
  std::optional<double> last_;
};

}  // namespace navvi_nav
