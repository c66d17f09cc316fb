#pragma once

#include <vector>

#include "navvi_nav/mesh.hpp"
#include "navvi_nav/vertex_pool.hpp"

namespace navvi_nav {

/// The vertices that the floor itself makes corners: holes can add their own, and take none away.
/// The groups at a pinch are told apart later.
class FloorCorners {
 public:
  /// Before the polygons round a vertex change.
  void forget(Mesh& mesh, VertexPool& pool, int vertex);
  /// After they got their links, while there are no holes. \param vertex  of its place, no twin
  void learn(Mesh& mesh, VertexPool& pool, int vertex);

 private:
  void set(Mesh& mesh, VertexPool& pool, int vertex, bool corner);

  std::vector<bool> corners_;  // by vertex
};

}  // namespace navvi_nav
