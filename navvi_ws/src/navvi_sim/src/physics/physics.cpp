#include "physics/physics.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "description/hash.hpp"
#include "physics/bullet_shapes.hpp"

namespace navvi_sim::physics {
namespace {

// Things have no margin, so that their surfaces are where the description says; the robot's is
// inside its radius.
constexpr double kRobotMargin = 0.01;  // m
constexpr int kRobot = 1;              // collision groups; things meet the robot only
constexpr int kThing = 2;

// In 10 steps of 0.01 s robot and mover come no more than 0.8 m closer, the robot at 3 m/s (World
// holds it to that), the mover at 5 m/s (WorldLimits).
constexpr std::uint64_t kGatherEach = 10;  // steps
constexpr double kEnter = 1.0;             // m, at which a thing comes into Bullet's world
constexpr double kLeave = 1.5;             // m, at which it leaves

/// One thing in Bullet.
struct Presence {
  std::vector<std::unique_ptr<btCollisionShape>> shapes;  ///< its parts, then the whole
  std::unique_ptr<btCollisionObject> object;
  btRigidBody* moving = nullptr;  ///< the same, if it moves
  std::size_t mover = 0;          ///< its index among the movers
};

/// rad, in (-pi, pi]
double wrapped(double angle) { return std::atan2(std::sin(angle), std::cos(angle)); }

btDefaultCollisionConstructionInfo pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 256;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
  return info;
}

}  // namespace

std::vector<navvi_types::Contact> ContactCounter::update(
    const std::vector<Touch>& touches, const std::vector<navvi_types::ThingClass>& classes,
    double speed, double dt) {
  for (auto held = held_.begin(); held != held_.end();) {
    const bool near = std::any_of(touches.begin(), touches.end(), [&](const Touch& touch) {
      return touch.thing == held->first && touch.distance <= kApart;
    });
    held->second = near ? 0.0 : held->second + dt;
    held = held->second >= kApartFor ? held_.erase(held) : std::next(held);
  }
  std::vector<navvi_types::Contact> begun;
  for (const Touch& touch : touches) {
    if (touch.distance > kTouching || !held_.emplace(touch.thing, 0.0).second) continue;
    ++counts_[classes[touch.thing]];
    navvi_types::Contact& contact = begun.emplace_back();
    contact.thing_class = classes[touch.thing];
    contact.point = touch.point.head<2>();
    contact.id = static_cast<std::uint32_t>(touch.thing);
    contact.height = touch.point.z();
    contact.speed = speed;
    contact.counts = counts_;
    contact.seq = ++seq_;
  }
  return begun;
}

struct Physics::Impl {
  explicit Impl(const Bodies& all) : bodies(all) {}
  ~Impl();

  const Bodies& bodies;
  // In this order: what is used is older than what uses it.
  MeshShapes meshes;
  btDefaultCollisionConfiguration configuration{pools()};
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::map<std::size_t, Presence> present;  ///< by thing
  std::unique_ptr<btCylinderShapeZ> hull;
  std::unique_ptr<btRigidBody> robot;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  // The hull is round and without friction, so no contact can turn it, and Bullet's body, whose
  // contact points would turn with it into what it touches, never does: the wheels alone turn it.
  double yaw = 0.0;                                         ///< rad, in (-pi, pi]
  double turn_rate = 0.0;                                   ///< rad/s
  Eigen::AlignedBox3d around;                               ///< the hull's bounds about its centre
  std::vector<std::pair<std::size_t, std::size_t>> wanted;  ///< thing, mover
  std::vector<Touch> touches;
  std::uint64_t steps = 0;

  void add_robot(const RobotConfig& config, double floor, const Eigen::Vector2d& position,
                 double start_yaw);
  void enter(const Body& body, const Eigen::Isometry3d& pose, std::size_t mover);
  void gather(const std::vector<MoverState>& movers);
  void find_touches();
};

Physics::Impl::~Impl() {
  for (int i = world.getNumCollisionObjects() - 1; i >= 0; --i)
    world.removeCollisionObject(world.getCollisionObjectArray()[i]);
}

void Physics::Impl::add_robot(const RobotConfig& config, double floor,
                              const Eigen::Vector2d& position, double start_yaw) {
  yaw = wrapped(start_yaw);
  const double half = 0.5 * (config.height - config.clearance);
  const Eigen::Vector3d extents(config.radius, config.radius, half);
  around = {-extents, extents};
  hull = std::make_unique<btCylinderShapeZ>(to_bt(extents));
  hull->setMargin(static_cast<btScalar>(kRobotMargin));
  robot = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(
      static_cast<btScalar>(config.mass), nullptr, hull.get()));
  const btTransform pose(
      btQuaternion::getIdentity(),
      to_bt(Eigen::Vector3d(position.x(), position.y(), floor + config.clearance + half)));
  robot->setWorldTransform(pose);
  robot->setInterpolationWorldTransform(pose);
  robot->setLinearFactor(btVector3(1, 1, 0));
  robot->setAngularFactor(btVector3(0, 0, 0));
  robot->setActivationState(DISABLE_DEACTIVATION);
  robot->setFriction(0);
  robot->setRestitution(0);
  robot->setUserIndex(-1);
  world.addRigidBody(robot.get(), kRobot, kThing);
}

/// \param pose  of a thing that moves
void Physics::Impl::enter(const Body& body, const Eigen::Isometry3d& pose, std::size_t mover) {
  Presence presence;
  auto compound = compound_of(body, meshes, presence.shapes);
  const btTransform at = body.moves ? to_bt(pose) : btTransform::getIdentity();
  if (body.moves) {
    auto rigid = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(0, nullptr, compound.get()));
    rigid->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    rigid->setActivationState(DISABLE_DEACTIVATION);
    rigid->setInterpolationWorldTransform(at);
    presence.moving = rigid.get();
    presence.mover = mover;
    presence.object = std::move(rigid);
  } else {
    presence.object = std::make_unique<btCollisionObject>();
    presence.object->setCollisionShape(compound.get());
  }
  presence.shapes.push_back(std::move(compound));
  presence.object->setWorldTransform(at);
  presence.object->setFriction(0);
  presence.object->setUserIndex(static_cast<int>(body.thing));
  if (presence.moving)
    world.addRigidBody(presence.moving, kThing, kRobot);
  else
    world.addCollisionObject(presence.object.get(), kThing, kRobot);
  present.emplace(body.thing, std::move(presence));
}

/// Takes in, in the order of things, what has come near, and lets go of what is far.
void Physics::Impl::gather(const std::vector<MoverState>& movers) {
  const Eigen::Vector3d centre = from_bt(robot->getWorldTransform().getOrigin());
  const Eigen::AlignedBox3d here(around.min() + centre, around.max() + centre);
  wanted.clear();
  const auto consider = [&](std::size_t thing, std::size_t mover, double distance) {
    if (distance <= kEnter || (distance <= kLeave && present.count(thing) > 0))
      wanted.emplace_back(thing, mover);
  };
  bodies.tree().search([&](const Eigen::AlignedBox3d& box) { return here.exteriorDistance(box); },
                       [] { return kLeave; },
                       [&](std::uint32_t index) {
                         const Body& body = bodies.all()[bodies.standing()[index]];
                         consider(body.thing, 0, here.exteriorDistance(body.bounds));
                       });
  const double radius = around.max().x();
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const double reach = kLeave + radius + movers[i].thing.radius;
    const Eigen::Vector2d away = movers[i].pose.translation().head<2>() - centre.head<2>();
    if (away.squaredNorm() < reach * reach)
      consider(movers[i].thing.id, i, away.norm() - radius - movers[i].thing.radius);
  }
  std::sort(wanted.begin(), wanted.end());
  for (auto entry = present.begin(); entry != present.end();) {
    const bool stays = std::binary_search(wanted.begin(), wanted.end(),
                                          std::make_pair(entry->first, entry->second.mover));
    if (stays) {
      ++entry;
      continue;
    }
    world.removeCollisionObject(entry->second.object.get());
    entry = present.erase(entry);
  }
  for (const auto& [thing, mover] : wanted) {
    if (present.count(thing) > 0) continue;
    const Body* body = bodies.of(thing);
    if (body) enter(*body, body->moves ? movers[mover].pose : Eigen::Isometry3d::Identity(), mover);
  }
}

void Physics::Impl::find_touches() {
  touches.clear();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    const bool robot_first = manifold.getBody0() == robot.get();
    const btCollisionObject* other = robot_first ? manifold.getBody1() : manifold.getBody0();
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& contact = manifold.getContactPoint(p);
      const btVector3& point =
          robot_first ? contact.getPositionWorldOnB() : contact.getPositionWorldOnA();
      touches.push_back(
          {static_cast<std::size_t>(other->getUserIndex()), contact.getDistance(), from_bt(point)});
    }
  }
  std::stable_sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) {
    return a.thing != b.thing ? a.thing < b.thing : a.distance < b.distance;
  });
  touches.erase(std::unique(touches.begin(), touches.end(),
                            [](const Touch& a, const Touch& b) { return a.thing == b.thing; }),
                touches.end());
}

Physics::Physics(const Bodies& bodies, double floor, const RobotConfig& robot,
                 const Eigen::Vector2d& position, double yaw)
    : impl_(std::make_unique<Impl>(bodies)) {
  impl_->world.setGravity(btVector3(0, 0, 0));
  impl_->world.setForceUpdateAllAabbs(false);
  impl_->world.getSolverInfo().m_numIterations = 20;
  impl_->meshes = meshes_of(bodies);
  impl_->add_robot(robot, floor, position, yaw);
  impl_->world.updateAabbs();
}

Physics::~Physics() = default;

void Physics::set_robot_velocity(const Eigen::Vector2d& velocity, double turn_rate) {
  impl_->robot->setLinearVelocity(to_bt(Eigen::Vector3d(velocity.x(), velocity.y(), 0.0)));
  impl_->turn_rate = turn_rate;
}

void Physics::advance(double dt, const std::vector<MoverState>& movers) {
  if (impl_->steps++ % kGatherEach == 0) impl_->gather(movers);
  for (auto& entry : impl_->present)
    if (entry.second.moving)
      entry.second.moving->setWorldTransform(to_bt(movers[entry.second.mover].pose));
  impl_->world.stepSimulation(static_cast<btScalar>(dt), 0);
  impl_->yaw = wrapped(impl_->yaw + impl_->turn_rate * dt);
  impl_->find_touches();
}

const std::vector<Touch>& Physics::touches() const { return impl_->touches; }

RobotState Physics::robot() const {
  RobotState state;
  state.position = from_bt(impl_->robot->getWorldTransform().getOrigin()).head<2>();
  state.yaw = impl_->yaw;
  state.velocity = from_bt(impl_->robot->getLinearVelocity()).head<2>();
  state.turn_rate = impl_->turn_rate;
  return state;
}

std::uint64_t Physics::hash(std::uint64_t hash) const {
  for (const btVector3& vector :
       {impl_->robot->getWorldTransform().getOrigin(), impl_->robot->getLinearVelocity()})
    for (const btScalar value : {vector.x(), vector.y(), vector.z()})
      hash = mix_bytes(hash, &value, sizeof value);
  for (const double value : {impl_->yaw, impl_->turn_rate}) hash = mix(hash, value);
  return hash;
}

}  // namespace navvi_sim::physics
