#include "physics/bullet_shapes.hpp"

namespace navvi_sim::physics {
namespace {

btCollisionShape* shape_of(const Part& part, const MeshShapes& meshes,
                           std::vector<std::unique_ptr<btCollisionShape>>& owned) {
  std::unique_ptr<btConvexInternalShape> shape;
  if (const auto* box = std::get_if<Box>(&part.geometry)) {
    shape = std::make_unique<btBoxShape>(to_bt(Eigen::Vector3d(0.5 * box->size)));
    shape->setMargin(0);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&part.geometry)) {
    shape = std::make_unique<btCylinderShapeZ>(
        to_bt(Eigen::Vector3d(cylinder->radius, cylinder->radius, 0.5 * cylinder->length)));
    shape->setMargin(0);
  } else if (const auto* sphere = std::get_if<Sphere>(&part.geometry)) {
    shape = std::make_unique<btSphereShape>(static_cast<btScalar>(sphere->radius));
  } else {
    return meshes.at(std::get<std::shared_ptr<const Mesh>>(part.geometry).get())->shape.get();
  }
  owned.push_back(std::move(shape));
  return owned.back().get();
}

}  // namespace

MeshShapes meshes_of(const Bodies& bodies) {
  MeshShapes meshes;
  for (const Body& body : bodies.all())
    for (const Part& part : body.parts)
      if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&part.geometry)) {
        auto& shape = meshes[mesh->get()];
        if (!shape) shape = std::make_unique<MeshShape>(**mesh);
      }
  return meshes;
}

std::unique_ptr<btCompoundShape> compound_of(
    const Body& body, const MeshShapes& meshes,
    std::vector<std::unique_ptr<btCollisionShape>>& owned) {
  auto compound = std::make_unique<btCompoundShape>();
  for (const Part& part : body.parts)
    compound->addChildShape(to_bt(part.pose), shape_of(part, meshes, owned));
  return compound;
}

}  // namespace navvi_sim::physics
