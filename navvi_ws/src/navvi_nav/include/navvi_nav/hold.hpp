#pragma once

#include "navvi_nav/way.hpp"

namespace navvi_nav {

struct HoldConfig {
  double hold_time = 8.0;
  double hold_choice = 3.0;
  double hold_meeting = 4.0;
  double hold_detour = 6.0;
  double wait_distance = 3.0;

  void describe(navvi_config::Visitor& visit);
};

/// Says whether to stay with a path that moving things cut, and remembers since when: a person is
/// not sent another way, and least of all back, because something passes by.
class Hold {
 public:
  explicit Hold(const HoldConfig& config) : config_(config) {}

  /// Call it before each search. \returns true to stay, without a search: all that cuts the path
  /// leaves it soon, which has not gone on for hold_time, or comes but is not met within
  /// hold_meeting
  [[nodiscard]] bool waits(double time, const Way& way);
  struct Choice {
    Path path;  ///< empty: no route
    Way way;    ///< how moving things leave it
  };
  /// Call it after a search. \returns true to stay although `fresh` is at hand: as waits(), or
  /// nothing is run into within hold_choice, while `fresh` leads before something that moves or the
  /// one followed was chosen within hold_choice
  [[nodiscard]] bool keeps(double time, const Choice& followed, const Choice& fresh);
  /// The path that is followed was chosen now because of what moves.
  void chose(double time) { chosen_ = time; }
  void reset();
  /// \param at  m along the path
  [[nodiscard]] bool is_near(double at) const { return at <= config_.wait_distance; }
  /// True if a person should wait for what moves right before them.
  [[nodiscard]] bool must_wait(const Way& way) const;

 private:
  [[nodiscard]] bool rests(const Way& way) const;
  [[nodiscard]] bool is_far(const Way& way) const;
  [[nodiscard]] bool goes_on(double time, bool held);

  HoldConfig config_;
  std::optional<double> since_;   // s
  std::optional<double> chosen_;  // s
};

}  // namespace navvi_nav
