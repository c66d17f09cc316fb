#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "plan/nav_mesh.hpp"
#include "voxel_world.hpp"

namespace navvi_nav {

using navvi_floor::SmallWorld;

inline plan::NavMesh mesh_of(SmallWorld& world, const plan::NavMeshConfig& config = {}) {
  plan::NavMesh mesh(config);
  EXPECT_EQ(mesh.set_map(world.voxels()).error, "");
  return mesh;
}

/// Number by number.
inline bool same(const mesh::Mesh& a, const mesh::Mesh& b) {
  if (a.vertices.size() != b.vertices.size() || a.polygons.size() != b.polygons.size())
    return false;
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    if (!(a.vertices[i].at == b.vertices[i].at) || a.vertices[i].corner != b.vertices[i].corner)
      return false;
  }
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    const mesh::Polygon& p = a.polygons[i];
    const mesh::Polygon& q = b.polygons[i];
    if (p.corners != q.corners || p.component != q.component ||
        p.portals.size() != q.portals.size())
      return false;
    for (std::size_t k = 0; k < p.portals.size(); ++k) {
      if (p.portals[k].to != q.portals[k].to || p.portals[k].right != q.portals[k].right ||
          p.portals[k].left != q.portals[k].left)
        return false;
    }
  }
  return true;
}

/// m, from a point to a block's outline; 0 inside
inline double distance_to(const SmallWorld::Block& block, Point p) {
  const double dx = std::max({block[0] - p.x, 0.0, p.x - block[2]});
  const double dy = std::max({block[1] - p.y, 0.0, p.y - block[3]});
  return std::hypot(dx, dy);
}

/// Points at most `step` m apart along the path.
inline std::vector<Point> points_along(const Path& path, double step) {
  std::vector<Point> out;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int parts = 1 + static_cast<int>(distance(path[i - 1], path[i]) / step);
    for (int k = 0; k <= parts; ++k)
      out.push_back(path[i - 1] + (static_cast<double>(k) / parts) * (path[i] - path[i - 1]));
  }
  return out;
}

/// A walled room of 20 x 14 m with boxes and cylinders anywhere.
struct RandomWorld {
  SmallWorld map;
  std::vector<Cylinder> cylinders;
  Point start;
  Point goal;

  explicit RandomWorld(unsigned seed) {
    std::mt19937 random(seed);
    const auto pick = [&random](int low, int high) {
      return static_cast<int>(random() % static_cast<unsigned>(high - low + 1)) + low;
    };
    map.room(20, 14);
    for (int i = 0; i < 14; ++i) {
      const double x = 0.05 * pick(20, 340);
      const double y = 0.05 * pick(20, 240);
      const double top = 0.05 * pick(1, 20);
      map.box(x, y, 0, x + 0.05 * pick(1, 50), y + 0.05 * pick(1, 30), top);
    }
    for (unsigned i = 0; i < 5; ++i)
      cylinders.push_back({i, {0.01 * pick(100, 1900), 0.01 * pick(100, 1300)}, 0.3, {}});
    start = {0.01 * pick(60, 1940), 0.01 * pick(60, 1340)};
    goal = {0.01 * pick(60, 1940), 0.01 * pick(60, 1340)};
  }
};

}  // namespace navvi_nav
