#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "navvi_sim/contact_counter.hpp"
#include "navvi_sim/robot.hpp"
#include "navvi_sim/world_description.hpp"

namespace navvi_sim {

/// A thing near the robot (R-SIM-7).
struct NearThing {
  std::size_t thing;        ///< index in WorldDescription::things
  double gap;               ///< m, hull to surface; 0 or less when touching
  Eigen::Vector3d nearest;  ///< m, nearest point of its surface, in map
};

/// The bodies of one world in Bullet, which nothing else in this project touches. Frame: map.
/// The robot is a dynamic cylinder held to the plane; things stand still, or are moved from
/// outside. Floors, and shapes lower than the robot's underside, have no body.
class Physics {
 public:
  /// \param description  valid (validate.hpp); it need not outlive the constructor
  Physics(const WorldDescription& description, const RobotConfig& robot,
          const Eigen::Vector2d& position, double yaw);
  ~Physics();
  Physics(const Physics&) = delete;
  Physics& operator=(const Physics&) = delete;

  void set_robot_velocity(const Eigen::Vector2d& velocity, double turn_rate);
  /// Moves a thing that has a route; within the next advance() it pushes with the speed of this.
  void move_thing(std::size_t thing, const Eigen::Isometry3d& pose);
  /// One step of `dt` s.
  void advance(double dt);

  [[nodiscard]] RobotState robot() const;
  /// What the last step brought within the contact threshold (0.02 m), ordered by thing.
  [[nodiscard]] std::vector<Touch> touches() const;
  /// The nearest surface point of each thing whose gap to the robot's hull is at most `radius` m,
  /// nearest first. Shapes wholly below the robot's underside, or whose underside is more than
  /// `ceiling` m above the floor, are left out.
  [[nodiscard]] std::vector<NearThing> proximity(double radius, double ceiling) const;
  /// Mixes every bit of the robot's state into `hash` (FNV-1a).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace navvi_sim
