#pragma once

#include <algorithm>
#include <deque>

namespace navvi_feedback::node {

/// Whether a program that wakes at a fixed rate is woken in time. A machine that is too busy delays
/// motors and words.
class Beat {
 public:
  /// \param late  s between two beats, from which on the second counts as late
  explicit Beat(double late) : late_(late) {}

  /// To be called with each beat. \param time  s, monotonic
  /// \returns true once in the life of the object: when kMany beats of the last kWindow s were late
  [[nodiscard]] bool becomes_late(double time) {
    const double between = last_ < 0.0 ? 0.0 : time - last_;
    last_ = time;
    longest_ = std::max(longest_, between);
    if (between >= late_) late_beats_.push_back(time);
    while (!late_beats_.empty() && time - late_beats_.front() > kWindow) late_beats_.pop_front();
    if (told_ || late_beats_.size() < kMany) return false;
    told_ = true;
    return true;
  }
  /// s, the longest between two beats so far.
  [[nodiscard]] double longest() const { return longest_; }
  [[nodiscard]] bool was_late() const { return told_; }

  static constexpr int kMany = 5;
  static constexpr double kWindow = 10.0;  ///< s

 private:
  double late_;
  double last_ = -1.0;
  double longest_ = 0.0;
  std::deque<double> late_beats_;  ///< their times
  bool told_ = false;
};

}  // namespace navvi_feedback::node
