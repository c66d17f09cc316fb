#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/physics/robot.hpp"

namespace navvi_sim::bench {

/// A square hall of cells of 9 x 9 m. Each may hold a loaded shelf and, driving around it, a pallet
/// robot; neighbours share the lane between their shelves. Those nearest to the middle come first.
/// \param cells    along each side
/// \param shelves  at most cells squared
/// \param movers   at most cells squared
[[nodiscard]] WorldDescription hall(int cells, std::size_t shelves, std::size_t movers);

/// Bullet used plainly on the bodies of a world: what a step costs without World. Movers run along
/// their routes at full speed and mind nobody; nothing is asked of the world but to step. Bounds
/// of what stands still are not renewed, and things meet the robot only.
class BareBullet {
 public:
  /// No meshes.
  BareBullet(const WorldDescription& description, const physics::RobotConfig& robot,
             const Pose2& start);
  ~BareBullet();

  /// \param speed  m/s, forward \param turn_rate  rad/s, counter-clockwise \param dt  s
  void step(double speed, double turn_rate, double dt);

 private:
  struct Mover {
    btRigidBody* body;
    Route route;
    std::size_t next;  ///< way-point
  };

  btRigidBody& add_body(double mass, btCollisionShape& shape, const Eigen::Isometry3d& pose,
                        int group, int mask);

  // In this order: what is used is older than what uses it.
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<Mover> movers_;
  btRigidBody* robot_ = nullptr;
};

}  // namespace navvi_sim::bench
