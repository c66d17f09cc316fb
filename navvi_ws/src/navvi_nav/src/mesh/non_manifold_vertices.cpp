#include "mesh/non_manifold_vertices.hpp"

#include <algorithm>

namespace navvi_nav::mesh {

constexpr double kNearlyStraight = 1e-9;  // rad, a free angle less under 180 degrees is a corner

int& NonManifoldVertices::walls(int vertex) {
  if (slot(vertex) >= walls_.size()) walls_.resize(2 * slot(vertex) + 64, 0);
  return walls_[slot(vertex)];
}

template <typename Visit>
void NonManifoldVertices::each_wall(const VertexPool& pool, const Polygon& polygon, Visit visit) {
  std::size_t portal = 0;
  for (const int corner : polygon.corners) {
    if (portal < polygon.portals.size() && polygon.portals[portal].right == corner) {
      ++portal;
    } else {
      visit(pool.place_of(corner));
    }
  }
}

void NonManifoldVertices::forget(const VertexPool& pool, const Polygon& polygon) {
  each_wall(pool, polygon, [this](int vertex) {
    if (walls(vertex)-- >= 2) suspects_.push_back(vertex);
  });
}

void NonManifoldVertices::learn(const VertexPool& pool, const Polygon& polygon) {
  each_wall(pool, polygon, [this](int vertex) { ++walls(vertex); });
}

void NonManifoldVertices::split(Mesh& mesh, VertexPool& pool, const std::vector<int>& changed) {
  for (const int index : changed) {
    for (const int corner : mesh.polygon(index).corners) {
      const int vertex = pool.place_of(corner);
      if (walls(vertex) >= 2) suspects_.push_back(vertex);
    }
  }
  std::sort(suspects_.begin(), suspects_.end());
  suspects_.erase(std::unique(suspects_.begin(), suspects_.end()), suspects_.end());
  for (const int vertex : suspects_) split_one(mesh, pool, vertex);
  suspects_.clear();
}

void NonManifoldVertices::keep_all() {
  for (auto& entry : duplicates_) entry.second.kept = entry.second.vertices.size();
}

void NonManifoldVertices::keep_none() {
  for (auto& entry : duplicates_) entry.second.kept = 0;
}

/// Finds the polygons with a corner at the vertex or a duplicate of it, and gives all of them the
/// vertex itself.
void NonManifoldVertices::find_wedges(Mesh& mesh, const VertexPool& pool, int vertex) {
  wedges_.clear();
  const Point at = mesh.at(vertex);
  mesh.grid.visit(at, at, [&](int index) {
    Polygon& polygon = mesh.polygons[slot(index)];
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      if (pool.place_of(polygon.corners[k]) != vertex) continue;
      wedges_.push_back({index, k, static_cast<int>(wedges_.size())});
      polygon.corners[k] = vertex;
      for (Portal& portal : polygon.portals) {
        if (pool.place_of(portal.right) == vertex) portal.right = vertex;
        if (pool.place_of(portal.left) == vertex) portal.left = vertex;
      }
    }
  });
  std::sort(wedges_.begin(), wedges_.end(),
            [](const Wedge& a, const Wedge& b) { return a.polygon < b.polygon; });
}

void NonManifoldVertices::group_wedges(const Mesh& mesh, int vertex) {
  for (std::size_t i = 0; i < wedges_.size(); ++i) wedges_[i].group = static_cast<int>(i);
  for (const Wedge& wedge : wedges_) {
    for (const Portal& portal : mesh.polygon(wedge.polygon).portals) {
      if (portal.right != vertex && portal.left != vertex) continue;
      const auto next = std::find_if(wedges_.begin(), wedges_.end(), [&portal](const Wedge& other) {
        return other.polygon == portal.to;
      });
      if (next == wedges_.end()) continue;
      const int low = std::min(wedge.group, next->group);
      const int high = std::max(wedge.group, next->group);
      for (Wedge& other : wedges_) {
        if (other.group == high) other.group = low;
      }
    }
  }
}

void NonManifoldVertices::split_one(Mesh& mesh, VertexPool& pool, int vertex) {
  find_wedges(mesh, pool, vertex);
  group_wedges(mesh, vertex);
  std::size_t used = 0;
  const bool corner = pool.marked(vertex);
  for (std::size_t first = 0; first < wedges_.size(); ++first) {
    const int group = wedges_[first].group;
    if (group != static_cast<int>(first)) continue;  // a group has the number of its first
    int own = vertex;
    if (first > 0) {
      Duplicates& duplicates = duplicates_[vertex];
      if (used == duplicates.vertices.size())
        duplicates.vertices.push_back(pool.duplicate(mesh.vertices, vertex));
      own = duplicates.vertices[used++];
      mesh.vertices[slot(own)].at = mesh.at(vertex);
    }
    double free = 0.0;
    for (std::size_t i = first; i < wedges_.size(); ++i) {
      if (wedges_[i].group != group) continue;
      Polygon& polygon = mesh.polygons[slot(wedges_[i].polygon)];
      polygon.corners[wedges_[i].corner] = own;
      for (Portal& portal : polygon.portals) {
        if (portal.right == vertex) portal.right = own;
        if (portal.left == vertex) portal.left = own;
      }
      free += mesh.angle_at(polygon, wedges_[i].corner);
    }
    mesh.vertices[slot(own)].corner = corner && free > kPi - kNearlyStraight;
  }
  const auto entry = duplicates_.find(vertex);
  if (entry == duplicates_.end()) return;
  std::vector<int>& duplicates = entry->second.vertices;
  while (duplicates.size() > std::max(used, entry->second.kept)) {
    pool.drop_duplicate(mesh.vertices, duplicates.back());
    duplicates.pop_back();
  }
}

}  // namespace navvi_nav::mesh
