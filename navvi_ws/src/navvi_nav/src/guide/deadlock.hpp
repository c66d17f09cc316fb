#pragma once

#include <map>
#include <navvi_config/field.hpp>
#include <optional>
#include <vector>

#include "guide/cylinders.hpp"

namespace navvi_nav::guide {

struct DeadlockConfig {
  double robot_radius = 0.35;  ///< m, set from the mesh's
  double make_room_after = 10.0;

  void describe(navvi_config::Visitor& visit);
};

/// The area that a thing will need next if it drives on as it heads, and some about its front for a
/// turn, as cylinders of it.
[[nodiscard]] std::vector<Cylinder> area_swept_by(const MovingThing& thing);

/// Decides when the robot yields: it notices that the robot and a thing that faces it wait for each
/// other, remembers to which thing the robot yields, and ends the wait in the retreat.
class Deadlock {
 public:
  explicit Deadlock(const DeadlockConfig& config) : config_(config) {}

  /// \param blocker  what closes the only path right in front of the robot now; nullopt: nothing
  void update(double time, Point robot, const std::optional<MovingThing>& blocker);
  /// The thing to which to yield now.
  [[nodiscard]] std::optional<std::uint32_t> due() const { return due_; }
  /// The robot is to leave the area that the thing will sweep.
  void yield_to(const MovingThing& thing);
  [[nodiscard]] std::optional<std::uint32_t> yields_to() const { return yields_to_; }
  /// As of the last yield_to().
  [[nodiscard]] const std::vector<Cylinder>& swept_area() const { return swept_area_; }
  /// True if the robot is close to the `end` of its retreat, or near it and out of the swept area.
  [[nodiscard]] bool has_retreated(Point robot, Point end) const;
  /// The robot retreated, to wait there. \pre yields_to()
  void retreated(double time);
  /// True while the thing is given time to pass.
  [[nodiscard]] bool waits(double time) const;
  void reset_times();
  /// A new goal, a new start.
  void reset();

 private:
  DeadlockConfig config_;
  std::optional<std::uint32_t> blocker_;
  double since_ = 0.0;  // s
  std::optional<std::uint32_t> due_;
  std::optional<std::uint32_t> yields_to_;
  std::vector<Cylinder> swept_area_;
  std::optional<double> retreated_at_;    // s
  std::map<std::uint32_t, int> yielded_;  // how often, by id
};

}  // namespace navvi_nav::guide
