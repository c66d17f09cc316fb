#include "physics/physics.hpp"

#include <algorithm>

#include "description/hash.hpp"

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

Physics::Physics(const Bodies& bodies, double floor, const RobotConfig& robot,
                 const Eigen::Vector2d& position, double yaw)
    : bodies_(bodies),
      meshes_(meshes_of(bodies)),
      configuration_(pools()),
      yaw_(wrapped(yaw)) {
  world_.setGravity(btVector3(0, 0, 0));
  world_.setForceUpdateAllAabbs(false);
  world_.getSolverInfo().m_numIterations = 20;
  const double half = 0.5 * (robot.height - robot.clearance);
  const Eigen::Vector3d extents(robot.radius, robot.radius, half);
  around_ = {-extents, extents};
  hull_ = std::make_unique<btCylinderShapeZ>(to_bt(extents));
  hull_->setMargin(static_cast<btScalar>(kRobotMargin));
  robot_ = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(
      static_cast<btScalar>(robot.mass), nullptr, hull_.get()));
  const btTransform pose(
      btQuaternion::getIdentity(),
      to_bt(Eigen::Vector3d(position.x(), position.y(), floor + robot.clearance + half)));
  robot_->setWorldTransform(pose);
  robot_->setInterpolationWorldTransform(pose);
  robot_->setLinearFactor(btVector3(1, 1, 0));
  robot_->setAngularFactor(btVector3(0, 0, 0));
  robot_->setActivationState(DISABLE_DEACTIVATION);
  robot_->setFriction(0);
  robot_->setRestitution(0);
  robot_->setUserIndex(-1);
  world_.addRigidBody(robot_.get(), kRobot, kThing);
  world_.updateAabbs();
}

Physics::~Physics() {
  for (int i = world_.getNumCollisionObjects() - 1; i >= 0; --i)
    world_.removeCollisionObject(world_.getCollisionObjectArray()[i]);
}

/// \param pose  of a thing that moves
void Physics::enter(const Body& body, const Eigen::Isometry3d& pose, std::size_t mover) {
  Presence presence;
  auto compound = compound_of(body, meshes_, presence.shapes);
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
    world_.addRigidBody(presence.moving, kThing, kRobot);
  else
    world_.addCollisionObject(presence.object.get(), kThing, kRobot);
  present_.emplace(body.thing, std::move(presence));
}

/// Takes in, in the order of things, what has come near, and lets go of what is far.
void Physics::gather(const std::vector<MoverState>& movers) {
  const Eigen::Vector3d centre = from_bt(robot_->getWorldTransform().getOrigin());
  const Eigen::AlignedBox3d here(around_.min() + centre, around_.max() + centre);
  wanted_.clear();
  const auto consider = [&](std::size_t thing, std::size_t mover, double distance) {
    if (distance <= kEnter || (distance <= kLeave && present_.count(thing) > 0))
      wanted_.emplace_back(thing, mover);
  };
  bodies_.tree().search(
      [&](const Eigen::AlignedBox3d& box) { return here.exteriorDistance(box); },
      [] { return kLeave; },
      [&](std::uint32_t index) {
        const Body& body = bodies_.all()[bodies_.standing()[index]];
        consider(body.thing, 0, here.exteriorDistance(body.bounds));
      });
  const double radius = around_.max().x();
  for (std::size_t i = 0; i < movers.size(); ++i) {
    const double reach = kLeave + radius + movers[i].thing.radius;
    const Eigen::Vector2d away = movers[i].pose.translation().head<2>() - centre.head<2>();
    if (away.squaredNorm() < reach * reach)
      consider(movers[i].thing.id, i, away.norm() - radius - movers[i].thing.radius);
  }
  std::sort(wanted_.begin(), wanted_.end());
  for (auto entry = present_.begin(); entry != present_.end();) {
    const bool stays = std::binary_search(wanted_.begin(), wanted_.end(),
                                          std::make_pair(entry->first, entry->second.mover));
    if (stays) {
      ++entry;
      continue;
    }
    world_.removeCollisionObject(entry->second.object.get());
    entry = present_.erase(entry);
  }
  for (const auto& [thing, mover] : wanted_) {
    if (present_.count(thing) > 0) continue;
    const Body* body = bodies_.of(thing);
    if (body) enter(*body, body->moves ? movers[mover].pose : Eigen::Isometry3d::Identity(), mover);
  }
}

void Physics::find_touches() {
  touches_.clear();
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
    const bool robot_first = manifold.getBody0() == robot_.get();
    const btCollisionObject* other = robot_first ? manifold.getBody1() : manifold.getBody0();
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& contact = manifold.getContactPoint(p);
      const btVector3& point =
          robot_first ? contact.getPositionWorldOnB() : contact.getPositionWorldOnA();
      touches_.push_back(
          {static_cast<std::size_t>(other->getUserIndex()), contact.getDistance(), from_bt(point)});
    }
  }
  std::stable_sort(touches_.begin(), touches_.end(), [](const Touch& a, const Touch& b) {
    return a.thing != b.thing ? a.thing < b.thing : a.distance < b.distance;
  });
  touches_.erase(std::unique(touches_.begin(), touches_.end(),
                             [](const Touch& a, const Touch& b) { return a.thing == b.thing; }),
                 touches_.end());
}

void Physics::set_robot_velocity(const Eigen::Vector2d& velocity, double turn_rate) {
  robot_->setLinearVelocity(to_bt(Eigen::Vector3d(velocity.x(), velocity.y(), 0.0)));
  turn_rate_ = turn_rate;
}

void Physics::advance(double dt, const std::vector<MoverState>& movers) {
  if (steps_++ % kGatherEach == 0) gather(movers);
  for (auto& entry : present_)
    if (entry.second.moving)
      entry.second.moving->setWorldTransform(to_bt(movers[entry.second.mover].pose));
  world_.stepSimulation(static_cast<btScalar>(dt), 0);
  yaw_ = wrapped(yaw_ + turn_rate_ * dt);
  find_touches();
}

RobotState Physics::robot() const {
  RobotState state;
  state.position = from_bt(robot_->getWorldTransform().getOrigin()).head<2>();
  state.yaw = yaw_;
  state.velocity = from_bt(robot_->getLinearVelocity()).head<2>();
  state.turn_rate = turn_rate_;
  return state;
}

std::uint64_t Physics::hash(std::uint64_t hash) const {
  for (const btVector3& vector :
       {robot_->getWorldTransform().getOrigin(), robot_->getLinearVelocity()})
    for (const btScalar value : {vector.x(), vector.y(), vector.z()})
      hash = mix_bytes(hash, &value, sizeof value);
  for (const double value : {yaw_, turn_rate_}) hash = mix(hash, value);
  return hash;
}

}  // namespace navvi_sim::physics
