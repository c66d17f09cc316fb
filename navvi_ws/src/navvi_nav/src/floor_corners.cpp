#include "navvi_nav/floor_corners.hpp"

#include <cmath>

namespace navvi_nav {
namespace {

constexpr double kStraight = 1e-12;  // rad, above the rounding of a sum of angles

/// The angle at a corner inside a polygon, rad.
double angle_at(Point before, Point corner, Point after) {
  const Point a = after - corner;
  const Point b = before - corner;
  return std::abs(std::atan2(cross(a, b), dot(a, b)));  // a straight one may come as -pi
}

}  // namespace

void FloorCorners::forget(Mesh& mesh, VertexPool& pool, int vertex) {
  set(mesh, pool, vertex, false);
}

void FloorCorners::learn(Mesh& mesh, VertexPool& pool, int vertex) {
  double free = 0.0;
  bool walled = false;
  const Point here = mesh.at(vertex);
  mesh.grid.visit(here, here, [&](int index) {
    const Polygon& polygon = mesh.polygon(index);
    const std::size_t count = polygon.corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int corner = polygon.corners[k];
      if (pool.place_of(corner) != vertex) continue;
      free += angle_at(mesh.at(polygon.corners[(k + count - 1) % count]), here,
                       mesh.at(polygon.corners[(k + 1) % count]));
      int links = 0;
      for (const Link& link : polygon.links)
        links += (link.right == corner ? 1 : 0) + (link.left == corner ? 1 : 0);
      walled = walled || links < 2;
    }
  });
  set(mesh, pool, vertex, walled && free > M_PI + kStraight);
}

void FloorCorners::set(Mesh& mesh, VertexPool& pool, int vertex, bool corner) {
  const auto index = static_cast<std::size_t>(vertex);
  if (index >= corners_.size()) corners_.resize(mesh.vertices.size(), false);
  if (corner && !corners_[index]) pool.mark(mesh.vertices, vertex);
  if (!corner && corners_[index]) pool.unmark(mesh.vertices, vertex);
  corners_[index] = corner;
}

}  // namespace navvi_nav
