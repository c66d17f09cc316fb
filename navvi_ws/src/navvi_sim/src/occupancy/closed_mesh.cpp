#include "occupancy/closed_mesh.hpp"

#include <algorithm>
#include <map>
#include <navvi_types/disjoint_sets.hpp>
#include <utility>

namespace navvi_sim::occupancy {
namespace {

using Corner = std::array<double, 3>;

/// Whether a ray along +x from the point crosses the side, in the plane; the same for both
/// triangles that share it.
bool crosses(Eigen::Vector3d a, Eigen::Vector3d b, const Eigen::Vector3d& point) {
  if ((a.y() > point.y()) == (b.y() > point.y())) return false;
  if (std::make_pair(b.y(), b.x()) < std::make_pair(a.y(), a.x())) std::swap(a, b);
  return point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

/// Whether the triangle lies straight above the point.
bool is_above(const Triangle& triangle, const Eigen::Vector3d& point) {
  const auto& [a, b, c] = triangle.corners;
  if ((crosses(a, b, point) != crosses(b, c, point)) == crosses(c, a, point)) return false;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.z() == 0.0) return false;
  return a.z() -
             (normal.x() * (point.x() - a.x()) + normal.y() * (point.y() - a.y())) / normal.z() >
         point.z();
}

}  // namespace

ClosedMesh::ClosedMesh(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const Triangle& triangle : triangles_)
    for (const Eigen::Vector3d& corner : triangle.corners) bounds_.extend(corner);
}

bool ClosedMesh::holds(const Eigen::Vector3d& point) const {
  if (!bounds_.contains(point)) return false;
  const auto above = std::count_if(triangles_.begin(), triangles_.end(),
                                   [&](const Triangle& one) { return is_above(one, point); });
  return above % 2 == 1;
}

Octants ClosedMesh::octants(const Cell& cell) const {
  Octants all{0U, 0U};
  for (unsigned i = 0; i < 8; ++i) {
    const Cell eighth = octant(cell, i);
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(eighth.half);
    if (!bounds_.intersects(Eigen::AlignedBox3d(eighth.centre - half, eighth.centre + half)))
      continue;
    const bool passed = std::any_of(
        triangles_.begin(), triangles_.end(),
        [&](const Triangle& triangle) { return triangle.overlap(eighth) != Overlap::none; });
    if (passed) {
      all.touched |= 1U << i;
    } else if (holds(eighth.centre)) {
      all.touched |= 1U << i;
      all.full |= 1U << i;
    }
  }
  return all;
}

std::vector<ClosedMesh> closed_parts(const std::vector<Triangle>& triangles) {
  std::map<Corner, std::size_t> corners;  // those at one place are one
  std::vector<std::array<std::size_t, 3>> indices;
  for (const Triangle& triangle : triangles) {
    std::array<std::size_t, 3> index{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& at = triangle.corners[i];
      index[i] = corners.emplace(Corner{at.x(), at.y(), at.z()}, corners.size()).first->second;
    }
    indices.push_back(index);
  }
  navvi_types::DisjointSets<std::size_t> joined(corners.size());
  std::map<std::pair<std::size_t, std::size_t>, int> sides;
  for (const auto& index : indices)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = index[i];
      const std::size_t b = index[(i + 1) % 3];
      joined.unite(a, b);
      ++sides[std::minmax(a, b)];
    }
  std::map<std::size_t, std::vector<Triangle>> parts;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    parts[joined.root(indices[i][0])].push_back(triangles[i]);
  for (const auto& [side, count] : sides)
    if (count % 2 == 1) parts.erase(joined.root(side.first));
  std::vector<ClosedMesh> closed;
  for (auto& [corner, surface] : parts) closed.emplace_back(std::move(surface));
  return closed;
}

}  // namespace navvi_sim::occupancy
