#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/vertex_pool.hpp"

namespace navvi_nav::mesh {

/// The places where groups of polygons touch in a point only, as between two obstacles that touch.
/// Each group gets a vertex of its own: a path cannot pass there, and what a search knows of a
/// vertex must not pass there either. A vertex is non-manifold if two walls begin at it.
class NonManifoldVertices {
 public:
  /// Before a polygon loses its portals.
  void forget(const VertexPool& pool, const Polygon& polygon);
  /// After a polygon got new portals.
  void learn(const VertexPool& pool, const Polygon& polygon);
  /// Gives each group at a non-manifold vertex its own vertex.
  /// \param changed  the polygons that got new portals
  void split(Mesh& mesh, VertexPool& pool, const std::vector<int>& changed);
  /// Duplicates that exist now stay in their places, used or not.
  void keep_all();
  /// Duplicates go when split() does not use them.
  void keep_none();

 private:
  struct Duplicates {
    std::vector<int> vertices;
    std::size_t kept = 0;
  };
  /// A polygon's corner at the vertex.
  struct Wedge {
    int polygon = 0;
    std::size_t corner = 0;
    int group = 0;
  };
  int& walls(int vertex);
  template <typename Visit>
  void each_wall(const VertexPool& pool, const Polygon& polygon, Visit visit);
  void find_wedges(Mesh& mesh, const VertexPool& pool, int vertex);
  void group_wedges(const Mesh& mesh, int vertex);
  void split_one(Mesh& mesh, VertexPool& pool, int vertex);

  std::vector<int> walls_;  // that begin at each vertex, its duplicates' included
  std::unordered_map<int, Duplicates> duplicates_;
  std::vector<int> suspects_;
  std::vector<Wedge> wedges_;
};

}  // namespace navvi_nav::mesh
