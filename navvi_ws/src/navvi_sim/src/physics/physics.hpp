#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "navvi_sim/description/mover_state.hpp"
#include "navvi_sim/physics/robot.hpp"
#include "physics/bodies.hpp"
#include "physics/contact_counter.hpp"

namespace navvi_sim::physics {

/// The robot among the bodies near it in Bullet, which nothing else in this project touches. The
/// robot is a dynamic cylinder held to the plane; it is round and without friction, so that contact
/// shoves it but never turns it. Things stand still, or are moved from outside. What is too far to
/// be touched soon is not in Bullet's world, so that a step costs what is near. Frame: map.
class Physics {
 public:
  /// \param bodies  of the world; outlives this
  /// \param floor   m, z of the surface the robot drives on
  Physics(const Bodies& bodies, double floor, const RobotConfig& robot,
          const Eigen::Vector2d& position, double yaw);
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  void set_robot_velocity(const Eigen::Vector2d& velocity, double turn_rate);
  /// One step of `dt` s, at most 0.01.
  /// \param movers  where the moving things are at its end, the same in each call; they push with
  ///                the speed that this makes
  void advance(double dt, const std::vector<MoverState>& movers);

  [[nodiscard]] RobotState robot() const;
  /// What the last step brought within the contact threshold (0.02 m), ordered by thing.
  [[nodiscard]] const std::vector<Touch>& touches() const;
  /// Mixes every bit of the robot's state into `hash` (FNV-1a).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navvi_sim::physics
