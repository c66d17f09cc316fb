#include "physics/ray_caster.hpp"

#include <algorithm>
#include <limits>

#include "physics/bullet_shapes.hpp"

namespace navvi_sim::physics {
namespace {

constexpr double kUnderside = 1e-3;  // m above the floor; what ends lower is the floor itself

}  // namespace

struct RayCaster::Impl {
  explicit Impl(const WorldDescription& description)
      : floor(description.floor_height),
        bodies(description, description.floor_height + kUnderside),
        meshes(meshes_of(bodies)) {}
  ~Impl() {
    for (int i = world.getNumCollisionObjects() - 1; i >= 0; --i)
      world.removeCollisionObject(world.getCollisionObjectArray()[i]);
  }

  double floor;  ///< m
  Bodies bodies;
  MeshShapes meshes;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btCollisionObject>> objects;
  std::vector<std::pair<std::size_t, btCollisionObject*>> moving;  ///< by thing, in order
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

RayCaster::RayCaster(const WorldDescription& description)
    : impl_(std::make_unique<Impl>(description)) {
  for (const Body& body : impl_->bodies.all()) {
    auto object = std::make_unique<btCollisionObject>();
    impl_->shapes.push_back(compound_of(body, impl_->meshes, impl_->shapes));
    object->setCollisionShape(impl_->shapes.back().get());
    object->setUserIndex(static_cast<int>(body.thing));
    impl_->world.addCollisionObject(object.get());
    if (body.moves) impl_->moving.emplace_back(body.thing, object.get());
    impl_->objects.push_back(std::move(object));
  }
}

RayCaster::~RayCaster() = default;

std::vector<RayEnd> RayCaster::cast(const Eigen::Vector3d& from,
                                    const std::vector<Eigen::Vector3d>& ways, double length,
                                    const std::vector<MoverState>& movers) {
  for (const MoverState& mover : movers) {
    const auto found =
        std::lower_bound(impl_->moving.begin(), impl_->moving.end(), std::size_t{mover.thing.id},
                         [](const auto& entry, std::size_t thing) { return entry.first < thing; });
    if (found == impl_->moving.end() || found->first != mover.thing.id) continue;
    found->second->setWorldTransform(to_bt(mover.pose));
    impl_->world.updateSingleAabb(found->second);
  }
  std::vector<RayEnd> ends;
  ends.reserve(ways.size());
  for (const Eigen::Vector3d& way : ways) {
    RayEnd end{length, RayEnd::kNothing};
    const double down = way.z() < 0.0 ? (impl_->floor - from.z()) / way.z() : length;
    if (down < length) end = {down, RayEnd::kFloor};
    const btVector3 begin = to_bt(from);
    const btVector3 finish = to_bt(Eigen::Vector3d(from + end.range * way));
    btCollisionWorld::ClosestRayResultCallback result(begin, finish);
    impl_->world.rayTest(begin, finish, result);
    if (result.hasHit())
      end = {end.range * static_cast<double>(result.m_closestHitFraction),
             static_cast<std::size_t>(result.m_collisionObject->getUserIndex())};
    ends.push_back(end);
  }
  return ends;
}

}  // namespace navvi_sim::physics
