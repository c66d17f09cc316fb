#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace navvi_types {

/// For a program that is called at a fixed rate: after it was halted (by the system, a debugger, a
/// frozen disk) it first takes the messages that have waited, and only then judges what is lost.
class StallGuard {
 public:
  struct Config {
    double halted = 0.5;    ///< s without a call
    double catch_up = 0.2;  ///< s
    double rarely = 2.0;    ///< s; a program that is always slow goes on nevertheless
  };

  StallGuard() = default;
  explicit StallGuard(const Config& config) : config_(config) {}

  /// To be called with each beat. \param time  s, of a clock that does not run backwards
  /// \param expected_since  s, since when calls are expected at all
  /// \return whether messages that have waited are still to be taken
  [[nodiscard]] bool catches_up(double time,
                                double expected_since = -std::numeric_limits<double>::infinity()) {
    const double first = std::isfinite(expected_since) ? expected_since : time;
    const double before = std::max(last_.value_or(first), expected_since);
    last_ = time;
    if (time - before > config_.halted && (!woke_ || time - *woke_ > config_.rarely)) woke_ = time;
    return woke_ && time - *woke_ < config_.catch_up;
  }

 private:
  Config config_;
  std::optional<double> last_;  ///< s, of the last beat
  std::optional<double> woke_;  ///< s, after it was halted
};

}  // namespace navvi_types
