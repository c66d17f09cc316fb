#include "navvi_sim/physics.hpp"

#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

namespace navvi_sim {
namespace {

// Things have no margin, so that their surfaces are where the description says; the robot's is
// inside its radius.
constexpr double kRobotMargin = 0.01;  // m
constexpr int kRobot = 1;              // collision groups; things meet the robot only
constexpr int kThing = 2;

btVector3 to_bt(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

Eigen::Vector3d from_bt(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bt(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                  static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                     to_bt(Eigen::Vector3d(pose.translation())));
}

/// A mesh that Bullet reads in place.
struct MeshBody {
  explicit MeshBody(std::shared_ptr<const Mesh> source) : mesh(std::move(source)) {
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(mesh->triangles.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh->triangles.data());
    part.m_triangleIndexStride = sizeof(mesh->triangles[0]);
    part.m_numVertices = static_cast<int>(mesh->vertices.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh->vertices.data());
    part.m_vertexStride = sizeof(mesh->vertices[0]);
    part.m_vertexType = PHY_FLOAT;
    triangles.addIndexedMesh(part, PHY_INTEGER);
    shape = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
    shape->setMargin(0);
  }
  std::shared_ptr<const Mesh> mesh;
  btTriangleIndexVertexArray triangles;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

/// Finds the point of convex bodies that is nearest to the robot's hull.
class NearestPoint {
 public:
  NearestPoint(const btConvexShape& hull, const btConvexShape& rounded_hull,
               const btTransform& robot, double radius)
      : hull_(hull), rounded_hull_(rounded_hull), robot_(robot), gap_(radius) {}

  void consider(const btConvexShape& shape, const btTransform& pose) {
    btPointCollector found = detect(hull_, shape, pose, nullptr);
    // Bodies that overlap are told apart by a hull with a margin, which knows how deep.
    if (!found.m_hasResult || found.m_distance < 1e-4)
      found = detect(rounded_hull_, shape, pose, &depth_);
    if (!found.m_hasResult || found.m_distance > gap_) return;
    gap_ = found.m_distance;
    nearest_ = from_bt(found.m_pointInWorld);
  }

  /// The best gap so far, or the search radius.
  [[nodiscard]] double gap() const { return gap_; }
  [[nodiscard]] const std::optional<Eigen::Vector3d>& nearest() const { return nearest_; }

 private:
  btPointCollector detect(const btConvexShape& hull, const btConvexShape& shape,
                          const btTransform& pose, btConvexPenetrationDepthSolver* depth) {
    btVoronoiSimplexSolver simplex;
    btGjkPairDetector gjk(&hull, &shape, &simplex, depth);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = robot_;
    input.m_transformB = pose;
    const double reach = std::max(gap_, 0.0) + 0.01;
    input.m_maximumDistanceSquared = static_cast<btScalar>(reach * reach);
    btPointCollector result;
    gjk.getClosestPoints(input, result, nullptr);
    return result;
  }

  const btConvexShape& hull_;
  const btConvexShape& rounded_hull_;
  btTransform robot_;
  double gap_;
  std::optional<Eigen::Vector3d> nearest_;
  btGjkEpaPenetrationDepthSolver depth_;
};

/// The triangles of a mesh near the robot, one by one.
class Triangles : public btTriangleCallback {
 public:
  Triangles(NearestPoint& nearest, const btTransform& mesh, const btVector3& low,
            const btVector3& high)
      : nearest_(nearest), mesh_(mesh), low_(low), high_(high) {}

  void processTriangle(btVector3* corners, int /*part*/, int /*index*/) override {
    const btVector3 a = mesh_ * corners[0], b = mesh_ * corners[1], c = mesh_ * corners[2];
    btVector3 low = a, high = a;
    for (const btVector3& corner : {b, c}) {
      low.setMin(corner);
      high.setMax(corner);
    }
    if (!TestAabbAgainstAabb2(low, high, low_, high_)) return;
    btTriangleShape triangle(a, b, c);
    triangle.setMargin(0);
    nearest_.consider(triangle, btTransform::getIdentity());
  }

 private:
  NearestPoint& nearest_;
  btTransform mesh_;
  btVector3 low_;
  btVector3 high_;
};

/// Gathers what the broad phase finds, but the robot.
struct Gather : btBroadphaseAabbCallback {
  bool process(const btBroadphaseProxy* proxy) override {
    const auto* object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
    if (object->getUserIndex() >= 0) found.push_back(object);
    return true;
  }
  std::vector<const btCollisionObject*> found;
};

template <typename Value>
std::uint64_t mix(std::uint64_t hash, Value value) {
  unsigned char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001B3ull;
  return hash;
}

btDefaultCollisionConstructionInfo pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 256;
  info.m_defaultMaxCollisionAlgorithmPoolSize = 256;
  return info;
}

}  // namespace

struct Physics::Impl {
  // In this order: what is used is older than what uses it.
  std::map<const Mesh*, std::unique_ptr<MeshBody>> meshes;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  btDefaultCollisionConfiguration configuration{pools()};
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::map<std::size_t, std::unique_ptr<btRigidBody>> moving;
  std::vector<std::unique_ptr<btCollisionObject>> standing;
  std::unique_ptr<btCylinderShapeZ> hull;          ///< sharp, to measure with
  std::unique_ptr<btCylinderShapeZ> rounded_hull;  ///< to collide with
  std::unique_ptr<btRigidBody> robot;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  double underside;  ///< m, z of the hull's lower face
  double floor;      ///< m

  ~Impl();
  btCollisionShape* shape_of(const Geometry& geometry);
  void add_thing(std::size_t id, const Thing& thing);
  void add_robot(const RobotConfig& config, const Eigen::Vector2d& position, double yaw);
  void consider(NearestPoint& nearest, const btCollisionShape& shape, const btTransform& pose,
                const btVector3& low, const btVector3& high) const;
};

Physics::Impl::~Impl() {
  for (int i = world.getNumCollisionObjects() - 1; i >= 0; --i)
    world.removeCollisionObject(world.getCollisionObjectArray()[i]);
}

btCollisionShape* Physics::Impl::shape_of(const Geometry& geometry) {
  std::unique_ptr<btConvexInternalShape> shape;
  if (const auto* box = std::get_if<Box>(&geometry)) {
    shape = std::make_unique<btBoxShape>(to_bt(Eigen::Vector3d(0.5 * box->size)));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    shape = std::make_unique<btCylinderShapeZ>(
        to_bt(Eigen::Vector3d(cylinder->radius, cylinder->radius, 0.5 * cylinder->length)));
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    shapes.push_back(std::make_unique<btSphereShape>(static_cast<btScalar>(sphere->radius)));
    return shapes.back().get();
  } else {
    const auto& mesh = std::get<std::shared_ptr<const Mesh>>(geometry);
    if (!mesh || mesh->triangles.empty()) return nullptr;
    auto& body = meshes[mesh.get()];
    if (!body) body = std::make_unique<MeshBody>(mesh);
    return body->shape.get();
  }
  shape->setMargin(0);
  shapes.push_back(std::move(shape));
  return shapes.back().get();
}

void Physics::Impl::add_thing(std::size_t id, const Thing& thing) {
  auto compound = std::make_unique<btCompoundShape>();
  const btTransform pose = to_bt(thing.pose);
  for (const Shape& shape : thing.shapes) {
    btCollisionShape* body = shape_of(shape.geometry);
    if (!body) continue;
    const btTransform local = to_bt(shape.pose);
    btVector3 low, high;
    body->getAabb(pose * local, low, high);
    if (high.z() >= underside) compound->addChildShape(local, body);
  }
  if (compound->getNumChildShapes() == 0) return;
  btCompoundShape* whole = compound.get();
  shapes.push_back(std::move(compound));
  if (thing.route) {
    auto body =
        std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, whole));
    body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body->setActivationState(DISABLE_DEACTIVATION);
    body->setWorldTransform(pose);
    body->setInterpolationWorldTransform(pose);
    body->setFriction(0);
    body->setUserIndex(static_cast<int>(id));
    world.addRigidBody(body.get(), kThing, kRobot);
    moving[id] = std::move(body);
  } else {
    auto body = std::make_unique<btCollisionObject>();
    body->setCollisionShape(whole);
    body->setWorldTransform(pose);
    body->setFriction(0);
    body->setUserIndex(static_cast<int>(id));
    world.addCollisionObject(body.get(), kThing, kRobot);
    standing.push_back(std::move(body));
  }
}

void Physics::Impl::add_robot(const RobotConfig& config, const Eigen::Vector2d& position,
                              double yaw) {
  const double half = 0.5 * (config.height - config.clearance);
  const btVector3 extents = to_bt(Eigen::Vector3d(config.radius, config.radius, half));
  hull = std::make_unique<btCylinderShapeZ>(extents);
  hull->setMargin(0);
  rounded_hull = std::make_unique<btCylinderShapeZ>(extents);
  rounded_hull->setMargin(static_cast<btScalar>(kRobotMargin));
  btVector3 inertia;
  const auto mass = static_cast<btScalar>(config.mass);
  rounded_hull->calculateLocalInertia(mass, inertia);
  robot = std::make_unique<btRigidBody>(
      btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, rounded_hull.get(), inertia));
  const btTransform pose(btQuaternion(btVector3(0, 0, 1), static_cast<btScalar>(yaw)),
                         to_bt(Eigen::Vector3d(position.x(), position.y(), underside + half)));
  robot->setWorldTransform(pose);
  robot->setInterpolationWorldTransform(pose);
  robot->setLinearFactor(btVector3(1, 1, 0));
  robot->setAngularFactor(btVector3(0, 0, 1));
  robot->setActivationState(DISABLE_DEACTIVATION);
  robot->setFriction(0);
  robot->setRestitution(0);
  robot->setUserIndex(-1);
  world.addRigidBody(robot.get(), kRobot, kThing);
}

void Physics::Impl::consider(NearestPoint& nearest, const btCollisionShape& shape,
                             const btTransform& pose, const btVector3& low,
                             const btVector3& high) const {
  btVector3 shape_low, shape_high;
  shape.getAabb(pose, shape_low, shape_high);
  if (!TestAabbAgainstAabb2(shape_low, shape_high, low, high)) return;
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i)
      consider(nearest, *compound.getChildShape(i), pose * compound.getChildTransform(i), low,
               high);
  } else if (shape.isConvex()) {
    nearest.consider(static_cast<const btConvexShape&>(shape), pose);
  } else {
    btVector3 local_low, local_high;
    btTransformAabb(low, high, 0, pose.inverse(), local_low, local_high);
    Triangles triangles(nearest, pose, low, high);
    static_cast<const btBvhTriangleMeshShape&>(shape).processAllTriangles(&triangles, local_low,
                                                                          local_high);
  }
}

Physics::Physics(const WorldDescription& description, const RobotConfig& robot,
                 const Eigen::Vector2d& position, double yaw)
    : impl_(std::make_unique<Impl>()) {
  impl_->floor = description.floor_height;
  impl_->underside = description.floor_height + robot.clearance;
  impl_->world.setGravity(btVector3(0, 0, 0));
  impl_->world.setForceUpdateAllAabbs(false);
  impl_->world.getSolverInfo().m_numIterations = 20;
  for (std::size_t id = 0; id < description.things.size(); ++id)
    if (description.things[id].thing_class != ThingClass::floor)
      impl_->add_thing(id, description.things[id]);
  impl_->add_robot(robot, position, yaw);
  impl_->world.updateAabbs();
}

Physics::~Physics() = default;

void Physics::set_robot_velocity(const Eigen::Vector2d& velocity, double turn_rate) {
  impl_->robot->setLinearVelocity(to_bt(Eigen::Vector3d(velocity.x(), velocity.y(), 0.0)));
  impl_->robot->setAngularVelocity(to_bt(Eigen::Vector3d(0.0, 0.0, turn_rate)));
}

void Physics::move_thing(std::size_t thing, const Eigen::Isometry3d& pose) {
  const auto body = impl_->moving.find(thing);
  if (body != impl_->moving.end()) body->second->setWorldTransform(to_bt(pose));
}

void Physics::advance(double dt) { impl_->world.stepSimulation(static_cast<btScalar>(dt), 0); }

RobotState Physics::robot() const {
  const btTransform& pose = impl_->robot->getWorldTransform();
  const btMatrix3x3& basis = pose.getBasis();
  RobotState state;
  state.position = from_bt(pose.getOrigin()).head<2>();
  state.yaw = std::atan2(basis[1][0], basis[0][0]);
  state.velocity = from_bt(impl_->robot->getLinearVelocity()).head<2>();
  state.turn_rate = impl_->robot->getAngularVelocity().z();
  return state;
}

std::vector<Touch> Physics::touches() const {
  std::map<std::size_t, Touch> nearest;
  for (int i = 0; i < impl_->dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *impl_->dispatcher.getManifoldByIndexInternal(i);
    const bool robot_first = manifold.getBody0() == impl_->robot.get();
    const btCollisionObject* other = robot_first ? manifold.getBody1() : manifold.getBody0();
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& contact = manifold.getContactPoint(p);
      const auto thing = static_cast<std::size_t>(other->getUserIndex());
      const btVector3& point =
          robot_first ? contact.getPositionWorldOnB() : contact.getPositionWorldOnA();
      const Touch touch{thing, contact.getDistance(), from_bt(point)};
      const auto [entry, is_new] = nearest.emplace(thing, touch);
      if (!is_new && touch.distance < entry->second.distance) entry->second = touch;
    }
  }
  std::vector<Touch> touches;
  for (const auto& entry : nearest) touches.push_back(entry.second);
  return touches;
}

std::vector<NearThing> Physics::proximity(double radius, double ceiling) const {
  const btTransform& robot = impl_->robot->getWorldTransform();
  btVector3 low, high;
  impl_->hull->getAabb(robot, low, high);
  const auto reach = static_cast<btScalar>(radius);
  low -= btVector3(reach, reach, 0);
  high += btVector3(reach, reach, reach);
  low.setZ(static_cast<btScalar>(impl_->underside));
  high.setZ(std::min(high.z(), static_cast<btScalar>(impl_->floor + ceiling)));

  Gather gather;
  impl_->broadphase.aabbTest(low, high, gather);
  std::vector<NearThing> things;
  for (const btCollisionObject* object : gather.found) {
    NearestPoint nearest(*impl_->hull, *impl_->rounded_hull, robot, radius);
    impl_->consider(nearest, *object->getCollisionShape(), object->getWorldTransform(), low, high);
    if (nearest.nearest())
      things.push_back(
          {static_cast<std::size_t>(object->getUserIndex()), nearest.gap(), *nearest.nearest()});
  }
  std::sort(things.begin(), things.end(), [](const NearThing& a, const NearThing& b) {
    return a.gap != b.gap ? a.gap < b.gap : a.thing < b.thing;
  });
  return things;
}

std::uint64_t Physics::hash(std::uint64_t hash) const {
  const btTransform& pose = impl_->robot->getWorldTransform();
  std::vector<btVector3> vectors{pose.getOrigin(), impl_->robot->getLinearVelocity(),
                                 impl_->robot->getAngularVelocity()};
  for (int row = 0; row < 3; ++row) vectors.push_back(pose.getBasis()[row]);
  for (const btVector3& vector : vectors)
    for (const btScalar value : {vector.x(), vector.y(), vector.z()}) hash = mix(hash, value);
  return hash;
}

}  // namespace navvi_sim
