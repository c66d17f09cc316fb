#include "bare_bullet.hpp"

namespace navvi_sim::bench {
namespace {

constexpr int kRobot = 1;  // collision groups
constexpr int kThing = 2;

btVector3 to_bt(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform to_bt(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                  static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                     to_bt(Eigen::Vector3d(pose.translation())));
}

}  // namespace

BareBullet::BareBullet(const WorldDescription& description, const physics::RobotConfig& robot,
                       const Pose2& start) {
  world_.setGravity(btVector3(0, 0, 0));
  world_.setForceUpdateAllAabbs(false);
  for (const Thing& thing : description.things)
    if (thing.thing_class != ThingClass::floor) add_thing(thing);

  const double half = 0.5 * (robot.height - robot.clearance);
  Eigen::Isometry3d pose(Eigen::AngleAxisd(start.yaw, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(start.position.x(), start.position.y(),
                                       description.floor_height + robot.clearance + half);
  robot_ = &add_body(
      robot.mass, keep<btCylinderShapeZ>(to_bt(Eigen::Vector3d(robot.radius, robot.radius, half))),
      to_bt(pose), kRobot, kThing);
  robot_->setLinearFactor(btVector3(1, 1, 0));
  robot_->setAngularFactor(btVector3(0, 0, 1));
  robot_->setActivationState(DISABLE_DEACTIVATION);
}

BareBullet::~BareBullet() {
  for (const auto& body : bodies_) world_.removeRigidBody(body.get());
}

template <typename Shape, typename... Arguments>
Shape& BareBullet::keep(Arguments&&... arguments) {
  auto shape = std::make_unique<Shape>(std::forward<Arguments>(arguments)...);
  Shape& kept = *shape;
  shapes_.push_back(std::move(shape));
  return kept;
}

btRigidBody& BareBullet::add_body(double mass, btCollisionShape& shape, const btTransform& pose,
                                  int group, int mask) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape.calculateLocalInertia(static_cast<btScalar>(mass), inertia);
  bodies_.push_back(std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(
      static_cast<btScalar>(mass), nullptr, &shape, inertia)));
  btRigidBody& body = *bodies_.back();
  body.setWorldTransform(pose);
  body.setInterpolationWorldTransform(pose);
  body.setFriction(0);
  world_.addRigidBody(&body, group, mask);
  return body;
}

void BareBullet::add_thing(const Thing& thing) {
  auto& whole = keep<btCompoundShape>();
  for (const Shape& shape : thing.shapes) {
    const btTransform local = to_bt(shape.pose);
    if (const auto* box = std::get_if<Box>(&shape.geometry))
      whole.addChildShape(local, &keep<btBoxShape>(to_bt(Eigen::Vector3d(0.5 * box->size))));
    else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry))
      whole.addChildShape(local, &keep<btCylinderShapeZ>(to_bt(Eigen::Vector3d(
                                     cylinder->radius, cylinder->radius, 0.5 * cylinder->length))));
    else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry))
      whole.addChildShape(local, &keep<btSphereShape>(static_cast<btScalar>(sphere->radius)));
  }
  btRigidBody& body = add_body(0.0, whole, to_bt(thing.pose), kThing, kRobot);
  if (!thing.route) return;
  body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);
  movers_.push_back({&body, *thing.route, 0});
}

void BareBullet::step(double speed, double turn_rate, double dt) {
  for (Mover& mover : movers_) {
    btTransform pose = mover.body->getWorldTransform();
    const Eigen::Vector2d& goal = mover.route.waypoints[mover.next].at;
    const btVector3 way(static_cast<btScalar>(goal.x()) - pose.getOrigin().x(),
                        static_cast<btScalar>(goal.y()) - pose.getOrigin().y(), 0);
    const auto stride = static_cast<btScalar>(mover.route.speed * dt);
    if (way.length() <= stride) {
      mover.next = (mover.next + 1) % mover.route.waypoints.size();
      continue;
    }
    pose.setOrigin(pose.getOrigin() + stride * way.normalized());
    pose.setRotation(btQuaternion(btVector3(0, 0, 1), btAtan2(way.y(), way.x())));
    mover.body->setWorldTransform(pose);
  }
  const btVector3 ahead = robot_->getWorldTransform().getBasis().getColumn(0);
  robot_->setLinearVelocity(static_cast<btScalar>(speed) * ahead);
  robot_->setAngularVelocity(btVector3(0, 0, static_cast<btScalar>(turn_rate)));
  world_.stepSimulation(static_cast<btScalar>(dt), 0);
}

}  // namespace navvi_sim::bench
