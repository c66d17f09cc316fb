#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace navvi_nav::guide {

/// The pace of a person who drives: mean forward speed with a time constant of 10 s, over the times
/// when the robot moved.
class MeanSpeed {
 public:
  void update(double time, double speed) {
    const double elapsed = last_ ? std::clamp(time - *last_, 0.0, 1.0) : 0.0;
    last_ = time;
    if (speed > kMoving) mean_ += (speed - mean_) * (1.0 - std::exp(-elapsed / kMemory));
  }
  [[nodiscard]] double value() const { return mean_; }  ///< m/s, > 0

 private:
  static constexpr double kMoving = 0.1;   // m/s
  static constexpr double kMemory = 10.0;  // s
  double mean_ = 0.7;                      // m/s, before the robot moved
  std::optional<double> last_;
};

}  // namespace navvi_nav::guide
