#pragma once

#include <Eigen/Core>
#include <cmath>
#include <navvi_config/field.hpp>
#include <navvi_types/motion.hpp>

namespace navvi_sim::physics {

/// rad, in (-pi, pi]
inline double wrapped(double angle) { return std::atan2(std::sin(angle), std::cos(angle)); }

/// What a real robot's odometry does not count exactly. All of it is off by default, and drawn from
/// the world's seed (wheel_odometry.hpp).
struct ImperfectionsConfig {
  double odometry_left = 0.0;   ///< share by which the left wheel's way is counted too long: as if
                                ///< its diameter were wrong (Borenstein and Feng, 1996)
  double odometry_noise = 0.0;  ///< m per root of a metre, standard deviation of each wheel's
                                ///< counted way (Chong and Kleeman, 1997)

  [[nodiscard]] bool odometry_drifts() const {
    return odometry_left != 0.0 || odometry_noise != 0.0;
  }

  void describe(navvi_config::Visitor& visit);
};

/// A differential drive robot: a vertical cylinder, and what its wheels can do (R-SIM-5).
struct RobotConfig {
  double radius = 0.35;  ///< m
  /// m, top above the floor, of its load, too: less than the headroom by what the voxels of a map
  /// and the margin of a contact come to
  double height = navvi_types::kHeadroom - 0.005;
  /// m, underside of the hull above the floor; what is lower is driven over
  double clearance = 0.05;
  double mass = 50.0;                 ///< kg, mass of the robot
  double max_speed = 0.9;             ///< m/s, forward and back
  double acceleration = 1.0;          ///< m/s^2, towards a larger speed
  double deceleration = navvi_types::kBrakes;  ///< m/s^2, towards a smaller speed
  double max_turn_rate = 1.5;         ///< rad/s, largest rate of turn
  double angular_acceleration = 4.0;  ///< rad/s^2, of turning, both ways
  double brake = 30.0;                ///< m/s^2, deceleration when commands fail to come
  double angular_brake = 60.0;        ///< rad/s^2, angular deceleration when commands fail to come
  ImperfectionsConfig imperfections;

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
  /// As the robot's wheels would report it. \param floor  m, z \param stamp  ns
  [[nodiscard]] navvi_types::Odometry odometry(double floor, std::int64_t stamp) const;
};

/// How hard the wheels may slow down.
enum class Braking { normal, emergency };

/// The wheels' speed after `dt`, from what they do now towards `command`, within the limits.
[[nodiscard]] navvi_types::Velocity servo(const RobotConfig& config,
                                          const navvi_types::Velocity& now,
                                          const navvi_types::Velocity& command, Braking braking,
                                          double dt);

}  // namespace navvi_sim::physics
