#pragma once

#include <cstdint>
#include <navvi_types/scenario.hpp>
#include <vector>

#include "navvi_sim/live/world.hpp"

namespace navvi_sim::live {

constexpr double kProximityRate = 50.0;  ///< Hz, simulated, at which proximity is published
constexpr double kObstaclesRate = 20.0;  ///< Hz, likewise of obstacles

/// What the world was stepped with, from one step on until the next such command.
struct AppliedCommand {
  std::uint64_t step = 0;  ///< of the world, 0 for its first
  navvi_types::Velocity velocity;
  physics::Braking braking = physics::Braking::normal;
};

/// One world in lockstep, with the record that proves what it did: the commands as they changed,
/// and its state before the first step and after each simulated second. It knows no ROS and no
/// clock, and steps as fast as it is asked to (R-SIM-8).
class Session {
 public:
  /// \param description  valid (validate.hpp)
  /// \param seed         of everything random while the world lives
  Session(const WorldDescription& description, const WorldConfig& config, const Pose2& start,
          std::uint64_t seed);

  /// Advances by one step; a command that is refused leaves no trace.
  [[nodiscard]] World::Status step(const navvi_types::Velocity& command,
                                   physics::Braking braking = physics::Braking::normal);

  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  /// True after one step in each 1 / `rate` s. \param rate  Hz
  [[nodiscard]] bool due(double rate) const;
  [[nodiscard]] const std::vector<AppliedCommand>& commands() const { return commands_; }
  [[nodiscard]] const std::vector<navvi_types::StateHash>& hashes() const { return hashes_; }

 private:
  World world_;
  double step_;  ///< s
  std::uint64_t steps_ = 0;
  std::vector<AppliedCommand> commands_;
  std::vector<navvi_types::StateHash> hashes_;
};

/// Goes on with recorded commands until the session has taken `steps` in all.
/// \param commands  ordered by step; before the first one the robot is braked
/// \return of the last step
World::Status replay(Session& session, const std::vector<AppliedCommand>& commands,
                     std::uint64_t steps);

}  // namespace navvi_sim::live
