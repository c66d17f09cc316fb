#pragma once

#include <Eigen/Core>
#include <navvi_config/field.hpp>
#include <navvi_safety/command_gate.hpp>

namespace navvi_sim {

/// A differential drive robot: a vertical cylinder, and what its wheels can do (R-SIM-5).
struct RobotConfig {
  double radius = 0.35;        ///< m
  double height = 0.5;         ///< m, top above the floor
  double clearance = 0.05;     ///< m, underside above the floor; lower things are driven over
  double mass = 50.0;          ///< kg
  double max_speed = 0.9;      ///< m/s, forward and back
  double acceleration = 1.0;   ///< m/s^2
  double deceleration = 2.0;   ///< m/s^2
  double max_turn_rate = 1.5;  ///< rad/s
  double angular_acceleration = 4.0;  ///< rad/s^2, to faster and to slower turning
  double brake = 30.0;                ///< m/s^2, when the last stage stops the wheels
  double angular_brake = 60.0;        ///< rad/s^2, likewise

  void describe(navvi_config::Visitor& visit);
};

/// Where the robot is, and how it moves: base_link in map.
struct RobotState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double yaw = 0.0;                                    ///< rad, (-pi, pi]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s, in map
  double turn_rate = 0.0;                              ///< rad/s, counter-clockwise

  /// m/s along the robot's own x
  [[nodiscard]] double forward_speed() const;
  /// m/s along the robot's own y: only a push makes it other than 0
  [[nodiscard]] double sideways_speed() const;
};

/// How hard the wheels may slow down.
enum class Braking { normal, emergency };

/// The wheels' speed after `dt`, from what they do now towards `command`, within the limits.
[[nodiscard]] navvi_safety::Velocity servo(const RobotConfig& config,
                                           const navvi_safety::Velocity& now,
                                           const navvi_safety::Velocity& command, Braking braking,
                                           double dt);

}  // namespace navvi_sim
