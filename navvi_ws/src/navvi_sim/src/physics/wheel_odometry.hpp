#pragma once

#include <cstdint>
#include <random>

#include "navvi_sim/physics/robot.hpp"

namespace navvi_sim::physics {

/// The robot's count of its own way, by how far its two wheels turned. With nothing set it is the
/// truth.
class WheelOdometry {
 public:
  /// \param step   s, > 0
  /// \param start  base_link in map; odom begins as map
  /// \param seed   of all that is random here
  WheelOdometry(const ImperfectionsConfig& flaws, double step, const RobotState& start,
                std::uint64_t seed)
      : flaws_(flaws), step_(step), random_(seed), now_(start) {}

  /// Counts how far the wheels turned in the step that led from `before` to `after`.
  void count(const RobotState& before, const RobotState& after);

  /// base_link in odom, as the count has it.
  [[nodiscard]] const RobotState& now() const { return now_; }
  /// Mixes what is to come into `hash`: nothing where nothing is set.
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  [[nodiscard]] double normal();

  ImperfectionsConfig flaws_;
  double step_;
  std::mt19937_64 random_;
  RobotState now_;
};

}  // namespace navvi_sim::physics
