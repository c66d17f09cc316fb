#pragma once

#include <map>
#include <navvi_config/field.hpp>
#include <optional>
#include <vector>

#include "navvi_nav/moving_thing.hpp"

namespace navvi_nav {

struct StandOffConfig {
  double make_room_after = 10.0;
  double wait_aside = 20.0;

  void describe(navvi_config::Visitor& visit);
};

/// The ground that a thing will need next if it goes on as it heads, and some about its front for a
/// turn, as cylinders of it.
[[nodiscard]] std::vector<Cylinder> ground_needed(const MovingThing& thing);

/// Notices that the robot and a thing that faces it wait for each other, and says when the robot
/// should make room, and when it has waited aside for long enough.
class StandOff {
 public:
  explicit StandOff(const StandOffConfig& config) : config_(config) {}

  /// \param blocker  what closes the only way right before the robot now; nullopt: nothing does
  void update(double time, Point robot, const std::optional<MovingThing>& blocker);
  /// The robot went aside for the thing, to wait there.
  void went_aside(double time, std::uint32_t thing);
  /// For whom to make room now.
  [[nodiscard]] std::optional<std::uint32_t> due() const { return due_; }
  /// For whom the robot waits aside.
  [[nodiscard]] std::optional<std::uint32_t> aside_for(double time) const;
  void reset();
  /// A new goal, a new start.
  void forget();

 private:
  StandOffConfig config_;
  std::optional<std::uint32_t> blocker_;
  double since_ = 0.0;  // s
  std::optional<std::uint32_t> due_;
  std::optional<std::uint32_t> aside_for_;
  double aside_since_ = 0.0;              // s
  std::map<std::uint32_t, int> yielded_;  // how often to whom
};

}  // namespace navvi_nav
