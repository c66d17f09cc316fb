#include "navvi_nav/pinches.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_nav {
namespace {

constexpr double kNearlyStraight = 1e-9;  // rad, a free angle less under 180 degrees is a corner

std::size_t slot(int index) { return static_cast<std::size_t>(index); }

}  // namespace

int& Pinches::walls(int vertex) {
  if (slot(vertex) >= walls_.size()) walls_.resize(2 * slot(vertex) + 64, 0);
  return walls_[slot(vertex)];
}

template <typename Visit>
void Pinches::each_wall(const VertexPool& pool, const Polygon& polygon, Visit visit) {
  std::size_t link = 0;
  for (const int corner : polygon.corners) {
    if (link < polygon.links.size() && polygon.links[link].right == corner) {
      ++link;
    } else {
      visit(pool.place_of(corner));
    }
  }
}

void Pinches::forget(const VertexPool& pool, const Polygon& polygon) {
  each_wall(pool, polygon, [this](int vertex) {
    if (walls(vertex)-- >= 2) suspects_.push_back(vertex);
  });
}

void Pinches::learn(const VertexPool& pool, const Polygon& polygon) {
  each_wall(pool, polygon, [this](int vertex) { ++walls(vertex); });
}

void Pinches::split(Mesh& mesh, VertexPool& pool, const std::vector<int>& changed) {
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

void Pinches::keep_all() {
  for (auto& entry : twins_) entry.second.kept = entry.second.vertices.size();
}

void Pinches::keep_none() {
  for (auto& entry : twins_) entry.second.kept = 0;
}

/// Polygons with a corner at the place, by number; the corner is made the place's first vertex.
void Pinches::find_wedges(Mesh& mesh, const VertexPool& pool, int vertex) {
  wedges_.clear();
  const Point at = mesh.at(vertex);
  mesh.grid.visit(at, at, [&](int index) {
    Polygon& polygon = mesh.polygons[slot(index)];
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      if (pool.place_of(polygon.corners[k]) != vertex) continue;
      wedges_.push_back({index, k, static_cast<int>(wedges_.size())});
      polygon.corners[k] = vertex;
      for (Link& link : polygon.links) {
        if (pool.place_of(link.right) == vertex) link.right = vertex;
        if (pool.place_of(link.left) == vertex) link.left = vertex;
      }
    }
  });
  std::sort(wedges_.begin(), wedges_.end(),
            [](const Wedge& a, const Wedge& b) { return a.polygon < b.polygon; });
}

void Pinches::group_wedges(const Mesh& mesh, int vertex) {
  for (std::size_t i = 0; i < wedges_.size(); ++i) wedges_[i].group = static_cast<int>(i);
  for (const Wedge& wedge : wedges_) {
    for (const Link& link : mesh.polygon(wedge.polygon).links) {
      if (link.right != vertex && link.left != vertex) continue;
      const auto next = std::find_if(wedges_.begin(), wedges_.end(), [&link](const Wedge& other) {
        return other.polygon == link.to;
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

void Pinches::split_one(Mesh& mesh, VertexPool& pool, int vertex) {
  find_wedges(mesh, pool, vertex);
  group_wedges(mesh, vertex);
  std::size_t used = 0;
  const bool corner = pool.marked(vertex);
  for (std::size_t first = 0; first < wedges_.size(); ++first) {
    const int group = wedges_[first].group;
    if (group != static_cast<int>(first)) continue;  // a group has the number of its first
    int own = vertex;
    if (first > 0) {
      Twins& twins = twins_[vertex];
      if (used == twins.vertices.size()) twins.vertices.push_back(pool.twin(mesh.vertices, vertex));
      own = twins.vertices[used++];
      mesh.vertices[slot(own)].at = mesh.at(vertex);
    }
    double free = 0.0;
    for (std::size_t i = first; i < wedges_.size(); ++i) {
      if (wedges_[i].group != group) continue;
      Polygon& polygon = mesh.polygons[slot(wedges_[i].polygon)];
      polygon.corners[wedges_[i].corner] = own;
      for (Link& link : polygon.links) {
        if (link.right == vertex) link.right = own;
        if (link.left == vertex) link.left = own;
      }
      free += mesh.angle_at(polygon, wedges_[i].corner);
    }
    mesh.vertices[slot(own)].corner = corner && free > M_PI - kNearlyStraight;
  }
  const auto entry = twins_.find(vertex);
  if (entry == twins_.end()) return;
  std::vector<int>& twins = entry->second.vertices;
  while (twins.size() > std::max(used, entry->second.kept)) {
    pool.drop_twin(mesh.vertices, twins.back());
    twins.pop_back();
  }
}

}  // namespace navvi_nav
