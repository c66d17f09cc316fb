#pragma once

#include <array>
#include <chrono>
#include <mutex>
#include <navvi_types/names.hpp>
#include <vector>

namespace navvi_feedback::devices {

/// From a cause to what a person feels or hears of it.
enum class Chain {
  sensed,   ///< what is near was sensed, by ROS time, to its message's coming
  motors,   ///< a proximity message came, to the call of the driver
  pattern,  ///< a contact came, to that call
  words,    ///< a cue was decided to begin, to the mix of its first sample
  answer,   ///< a button was seen, to the same
  silence   ///< words were decided to end, to a mix without them
};

/// How long these took. For any threads.
class Latencies {
 public:
  using Clock = std::chrono::steady_clock;
  /// In ms, to 0.1; what is beyond 1 s counts as 1 s but for `longest`.
  struct Figures {
    unsigned count = 0;
    double p50 = 0.0;
    double p99 = 0.0;
    double longest = 0.0;
  };

  /// Its effect is now.
  void add(Chain chain, Clock::time_point cause);
  void clear();
  [[nodiscard]] Figures figures(Chain chain) const;

 private:
  struct Counts {
    std::vector<unsigned> bins;
    unsigned count = 0;
    double longest = 0.0;  ///< ms
  };

  mutable std::mutex mutex_;
  std::array<Counts, navvi_types::names(Chain{}).size()> counts_;
};

}  // namespace navvi_feedback::devices
