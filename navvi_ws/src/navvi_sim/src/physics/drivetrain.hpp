#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <navvi_types/motion.hpp>
#include <random>

#include "navvi_sim/physics/robot.hpp"

namespace navvi_sim::physics {

/// What lies between a command and the body, and between the body and its odometry: two wheels that
/// may slip, a command that may be late, and a count of the wheels' turning that may err. With
/// nothing set it is exact: the servo alone, and an odometry that is the truth.
class Drivetrain {
 public:
  /// \param step   s, > 0
  /// \param start  base_link in map; odom begins as map
  /// \param seed   of all that is random here
  Drivetrain(const RobotConfig& config, double step, const RobotState& start, std::uint64_t seed);

  /// The velocity that the wheels give the body in the next step.
  /// \param body  what contact left of the last one
  /// \param braking  an emergency is never late, and forgets what was under way
  [[nodiscard]] navvi_types::Velocity drive(const navvi_types::Velocity& body,
                                            const navvi_types::Velocity& command, Braking braking);
  /// Counts how far the wheels turned in the step that led from `before` to `after`.
  void count(const RobotState& before, const RobotState& after);

  /// base_link in odom, as the count of the wheels has it.
  [[nodiscard]] const RobotState& odometry() const { return odometry_; }
  /// Mixes what is to come into `hash`: nothing where nothing is set.
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  /// Of the left and the right wheel: m, m/s, or a factor.
  struct Pair {
    double left = 0.0;
    double right = 0.0;
  };

  [[nodiscard]] Pair wheels_of(double forward, double turn) const;
  [[nodiscard]] navvi_types::Velocity body_of(const Pair& wheels) const;
  [[nodiscard]] navvi_types::Velocity late(const navvi_types::Velocity& command, Braking braking);
  void draw_slip();
  [[nodiscard]] double normal();

  RobotConfig config_;
  ImperfectionsConfig flaws_;
  double step_;
  std::mt19937_64 random_;
  std::deque<navvi_types::Velocity> under_way_;  ///< commands, the oldest first
  Pair noise_;                                   ///< of the slip
  Pair grip_;  ///< what of a wheel's turning becomes way on the floor
  RobotState odometry_;
};

}  // namespace navvi_sim::physics
