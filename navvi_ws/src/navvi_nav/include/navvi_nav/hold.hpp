#pragma once

#include "navvi_nav/way.hpp"

namespace navvi_nav {

struct HoldConfig {
  double hold_time = 8.0;
  double hold_meeting = 4.0;
  double wait_distance = 3.0;

  void describe(navvi_config::Visitor& visit);
};

/// Says whether to stay with a path that moving things cut, and remembers since when: a person is
/// not sent another way, and least of all back, because something passes by.
class Hold {
 public:
  explicit Hold(const HoldConfig& config) : config_(config) {}

  /// Call it before each search. \returns true to stay, without a search: all that cuts the path
  /// leaves it soon, and that has not gone on for hold_time
  [[nodiscard]] bool waits(double time, const Way& way);
  /// Call it after a search. \returns true to stay although `fresh` (empty: no route) is at hand:
  /// what cuts the path crosses it, or comes but is not met within hold_meeting while `fresh` leads
  /// back, and that has not gone on for hold_time
  [[nodiscard]] bool keeps(double time, const Way& way, const Path& followed, const Path& fresh);
  void reset() { since_.reset(); }
  /// \param at  m along the path
  [[nodiscard]] bool is_near(double at) const { return at <= config_.wait_distance; }
  /// True if a person should wait for what crosses right before them.
  [[nodiscard]] bool must_wait(const Way& way) const;

 private:
  [[nodiscard]] bool goes_on(double time, bool held);

  HoldConfig config_;
  std::optional<double> since_;  // s
};

}  // namespace navvi_nav
