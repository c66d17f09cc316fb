#pragma once

#include <btBulletDynamicsCommon.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <navvi_types/thing.hpp>
#include <utility>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/physics/robot.hpp"
#include "physics/bodies.hpp"
#include "physics/bullet_shapes.hpp"

namespace navvi_sim::physics {

/// The least distance between the robot's body and one thing near it.
struct Touch {
  std::size_t thing;      ///< index in WorldDescription::things
  double distance;        ///< m, negative where they overlap
  Eigen::Vector3d point;  ///< m, on the thing, in map
};

using ContactCounts = std::map<navvi_types::ThingClass, std::uint32_t>;

/// Counts each contact once, at its begin. A thing counts again only after it was apart from the
/// robot for a while.
class ContactCounter {
 public:
  static constexpr double kTouching = 0.003;  ///< m, nearer is contact
  static constexpr double kApart = 0.02;      ///< m, farther is apart
  static constexpr double kApartFor = 0.2;    ///< s

  /// \param touches  at most one per thing, ordered by thing; a thing that is absent is far
  /// \param classes  of all things
  /// \param speed    m/s, the robot's before any contact that begins now
  /// \param dt       s, since the last call
  /// \return contacts that began, without the thing's name, the robot's pose and a stamp
  [[nodiscard]] std::vector<navvi_types::Contact> update(
      const std::vector<Touch>& touches, const std::vector<navvi_types::ThingClass>& classes,
      double speed, double dt);

  [[nodiscard]] const ContactCounts& counts() const { return counts_; }
  /// Things in contact, or not long enough apart, with the time they have been apart in s.
  [[nodiscard]] const std::map<std::size_t, double>& held() const { return held_; }

 private:
  std::map<std::size_t, double> held_;
  ContactCounts counts_;
  std::uint32_t seq_ = 0;
};

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

  void set_robot_velocity(const Eigen::Vector2d& velocity, double turn_rate);
  /// One step of `dt` s, at most 0.01.
  /// \param movers  where the moving things are at its end, the same in each call; they push with
  ///                the speed that this makes
  void advance(double dt, const std::vector<MoverState>& movers);

  [[nodiscard]] RobotState robot() const;
  /// What the last step brought within the contact threshold (0.02 m), ordered by thing.
  [[nodiscard]] const std::vector<Touch>& touches() const { return touches_; }
  /// Mixes every bit of the robot's state into `hash` (FNV-1a).
  [[nodiscard]] std::uint64_t hash(std::uint64_t hash) const;

 private:
  /// One thing in Bullet.
  struct Presence {
    std::vector<std::unique_ptr<btCollisionShape>> shapes;  ///< its parts, then the whole
    std::unique_ptr<btCollisionObject> object;
    btRigidBody* moving = nullptr;  ///< the same, if it moves
    std::size_t mover = 0;          ///< its index among the movers
  };

  void enter(const Body& body, const Eigen::Isometry3d& pose, std::size_t mover);
  void gather(const std::vector<MoverState>& movers);
  void find_touches();

  const Bodies& bodies_;
  // In this order: what is used is older than what uses it.
  MeshShapes meshes_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::map<std::size_t, Presence> present_;  ///< by thing
  std::unique_ptr<btCylinderShapeZ> hull_;
  std::unique_ptr<btRigidBody> robot_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  // The hull is round and without friction, so no contact can turn it, and Bullet's body, whose
  // contact points would turn with it into what it touches, never does: the wheels alone turn it.
  double yaw_;                                               ///< rad, in (-pi, pi]
  double turn_rate_ = 0.0;                                   ///< rad/s
  Eigen::AlignedBox3d around_;                               ///< the hull's bounds about its centre
  std::vector<std::pair<std::size_t, std::size_t>> wanted_;  ///< thing, mover
  std::vector<Touch> touches_;
  std::uint64_t steps_ = 0;
};

}  // namespace navvi_sim::physics
