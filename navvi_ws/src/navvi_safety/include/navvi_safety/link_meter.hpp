#pragma once

#include <cstdint>
#include <deque>
#include <navvi_types/link_state.hpp>

namespace navvi_safety {

/// Measures the connection between the person and the robot by the ages of commands. A command is
/// stamped with the robot's own time, as the person's side knew it last, so that its age is that of
/// what the person acted upon: the whole round trip, on one clock.
class LinkMeter {
 public:
  using Late = navvi_types::LinkState::Late;

  /// \param age  s, of a command as it comes \param seq  its number \param time  s, monotonic
  void add(double age, std::uint32_t seq, double time);
  /// A later command was here first.
  [[nodiscard]] bool overtaken(std::uint32_t seq) const {
    constexpr std::uint32_t kClose = 25;  // farther back, the person's side was started anew
    return !arrivals_.empty() && seq < arrivals_.back().seq && arrivals_.back().seq - seq < kClose;
  }
  /// How much later than usual, the median of the last 5 s, a command of that age is.
  [[nodiscard]] Late lateness(double age) const;
  /// Of the last command.
  [[nodiscard]] Late late() const { return late_; }
  /// As of the last command. \param stamp  ns, of the value
  [[nodiscard]] navvi_types::LinkState state(std::int64_t stamp) const;

 private:
  struct Arrival {
    double time = 0.0;      ///< s
    double age = 0.0;       ///< s
    std::uint32_t seq = 0;
  };
  [[nodiscard]] double percentile(double share) const;

  std::deque<Arrival> arrivals_;  ///< of the last 5 s
  Late late_ = Late::no;
};

}  // namespace navvi_safety
