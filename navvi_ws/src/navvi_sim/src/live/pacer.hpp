#pragma once

#include <cmath>

namespace navvi_sim::live {

/// How many fixed steps are due, so that simulated time keeps pace with a wall clock. When it
/// falls behind by more than `max_steps` it lets go of the rest: the simulation slows down, and
/// the step never grows.
class Pacer {
 public:
  /// \param step       s of simulated time, > 0
  /// \param rate       simulated seconds per second of wall time, > 0
  /// \param max_steps  most steps due at once, > 0
  Pacer(double step, double rate, int max_steps) : wall_step_(step / rate), max_steps_(max_steps) {}

  /// \param wall  s, monotonic; the first call only starts the count
  [[nodiscard]] int due(double wall) {
    if (!started_ || wall < origin_) {
      started_ = true;
      origin_ = wall;
      steps_ = 0;
      return 0;
    }
    const long target = static_cast<long>(std::floor((wall - origin_) / wall_step_ + 1e-9));
    const long missing = target - steps_;
    steps_ = target;
    if (missing <= max_steps_) return static_cast<int>(missing);
    dropped_ += missing - max_steps_;
    return max_steps_;
  }

  /// Steps let go so far.
  [[nodiscard]] long dropped() const { return dropped_; }

 private:
  double wall_step_;
  int max_steps_;
  bool started_ = false;
  double origin_ = 0.0;  ///< s, wall time of step number 0
  long steps_ = 0;       ///< since origin_
  long dropped_ = 0;
};

}  // namespace navvi_sim::live
