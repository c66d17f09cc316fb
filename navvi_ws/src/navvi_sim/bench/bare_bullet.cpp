#include "bare_bullet.hpp"

#include <algorithm>

#include "generate/furniture.hpp"
#include "physics/bullet_shapes.hpp"

namespace navvi_sim::bench {
namespace {

constexpr double kCell = 9.0;  // m

Thing shelf(const std::string& name, const Eigen::Vector2d& at) {
  Thing thing{name, ThingClass::shelf, generate::at(at.x(), at.y(), 0.0), {}, {}};
  for (const double height : {0.0, 0.8, 1.6}) {
    thing.shapes.push_back(generate::box_on(0.0, 0.0, height, 5.0, 1.2, 0.1));
    for (const double x : {-2.0, -1.0, 0.0, 1.0, 2.0})
      thing.shapes.push_back(generate::box_on(x, 0.0, height + 0.1, 0.7, 0.6, 0.5));
  }
  return thing;
}

Thing mover(const std::string& name, const Eigen::Vector2d& at, double speed) {
  const double x = 4.7, y = 3.0;
  Thing thing{name, ThingClass::pallet_robot, generate::at(at.x(), at.y() - y, 0.0), {}, {}};
  thing.shapes.push_back(generate::box_on(0.0, 0.0, 0.03, 0.9, 0.7, 0.25));
  thing.shapes.push_back(generate::box_on(-0.05, 0.0, 0.28, 0.6, 0.5, 0.6));
  Route route;
  route.speed = speed;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y),
                                        Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)})
    route.waypoints.push_back({at + corner});
  route.waypoints[0].pause = 2.0;
  thing.route = route;
  return thing;
}

constexpr int kRobot = 1;  // collision groups
constexpr int kThing = 2;

}  // namespace

WorldDescription hall(int cells, std::size_t shelves, std::size_t movers) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      places.push_back(kCell * Eigen::Vector2d(i - cells / 2, j - cells / 2));
  std::stable_sort(places.begin(), places.end(),
                   [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
                     return a.squaredNorm() < b.squaredNorm();
                   });
  WorldDescription world;
  world.name = "hall";
  Thing floor{"floor", ThingClass::floor, generate::at(0.0, 0.0, 0.0), {}, {}};
  const double side = kCell * (cells + 1);
  floor.shapes.push_back(generate::box_on(0.0, 0.0, -0.1, side, side, 0.1));
  world.things.push_back(floor);
  for (std::size_t i = 0; i < shelves; ++i)
    world.things.push_back(shelf("shelf_" + std::to_string(i), places.at(i)));
  for (std::size_t i = 0; i < movers; ++i)
    world.things.push_back(
        mover("mover_" + std::to_string(i), places.at(i), 0.8 + 0.05 * static_cast<double>(i % 9)));
  return world;
}

BareBullet::BareBullet(const WorldDescription& description, const physics::RobotConfig& robot,
                       const Pose2& start) {
  world_.setGravity(btVector3(0, 0, 0));
  world_.setForceUpdateAllAabbs(false);
  const physics::Bodies bodies(description, description.floor_height + robot.clearance);
  for (const physics::Body& body : bodies.all()) {
    shapes_.push_back(physics::compound_of(body, {}, shapes_));
    const Thing& thing = description.things[body.thing];
    const Eigen::Isometry3d pose = body.moves ? thing.pose : Eigen::Isometry3d::Identity();
    btRigidBody& added = add_body(0.0, *shapes_.back(), pose, kThing, kRobot);
    if (!body.moves) continue;
    added.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    added.setActivationState(DISABLE_DEACTIVATION);
    movers_.push_back({&added, *thing.route, 0});
  }

  const double half = 0.5 * (robot.height - robot.clearance);
  Eigen::Isometry3d pose(Eigen::AngleAxisd(start.yaw, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(start.position.x(), start.position.y(),
                                       description.floor_height + robot.clearance + half);
  shapes_.push_back(std::make_unique<btCylinderShapeZ>(
      physics::to_bt(Eigen::Vector3d(robot.radius, robot.radius, half))));
  robot_ = &add_body(robot.mass, *shapes_.back(), pose, kRobot, kThing);
  robot_->setLinearFactor(btVector3(1, 1, 0));
  robot_->setAngularFactor(btVector3(0, 0, 1));
  robot_->setActivationState(DISABLE_DEACTIVATION);
}

BareBullet::~BareBullet() {
  for (const auto& body : bodies_) world_.removeRigidBody(body.get());
}

btRigidBody& BareBullet::add_body(double mass, btCollisionShape& shape,
                                  const Eigen::Isometry3d& pose, int group, int mask) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape.calculateLocalInertia(static_cast<btScalar>(mass), inertia);
  bodies_.push_back(std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(
      static_cast<btScalar>(mass), nullptr, &shape, inertia)));
  btRigidBody& body = *bodies_.back();
  body.setWorldTransform(physics::to_bt(pose));
  body.setInterpolationWorldTransform(physics::to_bt(pose));
  body.setFriction(0);
  world_.addRigidBody(&body, group, mask);
  return body;
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
