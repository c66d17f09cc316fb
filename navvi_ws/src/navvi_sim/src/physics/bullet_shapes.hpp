#pragma once

#include <btBulletCollisionCommon.h>

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <vector>

#include "physics/bodies.hpp"

namespace navvi_sim::physics {

static_assert(sizeof(btScalar) == sizeof(double),
              "The Bullet that was found has single precision; NavVI needs the module "
              "bullet-float64, by which all machines record the same worlds.");

inline btVector3 to_bt(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

inline Eigen::Vector3d from_bt(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline btTransform to_bt(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return btTransform(btQuaternion(static_cast<btScalar>(q.x()), static_cast<btScalar>(q.y()),
                                  static_cast<btScalar>(q.z()), static_cast<btScalar>(q.w())),
                     to_bt(Eigen::Vector3d(pose.translation())));
}

/// A mesh that Bullet reads in place.
struct MeshShape {
  explicit MeshShape(const Mesh& mesh) {
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(mesh.triangles.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.triangles.data());
    part.m_triangleIndexStride = sizeof(mesh.triangles[0]);
    part.m_numVertices = static_cast<int>(mesh.vertices.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.vertices.data());
    part.m_vertexStride = sizeof(mesh.vertices[0]);
    part.m_vertexType = PHY_FLOAT;
    triangles.addIndexedMesh(part, PHY_INTEGER);
    shape = std::make_unique<btBvhTriangleMeshShape>(&triangles, true);
    shape->setMargin(0);
  }
  btTriangleIndexVertexArray triangles;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

/// The meshes of a world, each made once.
using MeshShapes = std::map<const Mesh*, std::unique_ptr<MeshShape>>;

[[nodiscard]] MeshShapes meshes_of(const Bodies& bodies);

/// All parts of a body as one shape. \param owned  gets the shapes of its parts, which outlive it
[[nodiscard]] std::unique_ptr<btCompoundShape> compound_of(
    const Body& body, const MeshShapes& meshes,
    std::vector<std::unique_ptr<btCollisionShape>>& owned);

}  // namespace navvi_sim::physics
