#pragma once

#include <unordered_map>
#include <vector>

#include "navvi_nav/mesh.hpp"
#include "navvi_nav/vertex_pool.hpp"

namespace navvi_nav {

/// Where polygons meet in a point and no link joins them, as two obstacles that touch leave them,
/// each group gets a vertex of its own: a path can not pass there, and what a search knows of a
/// vertex must not pass there either. A place is such a pinch if two walls begin at it.
class Pinches {
 public:
  /// Before a polygon loses its links.
  void forget(const VertexPool& pool, const Polygon& polygon);
  /// After a polygon got new links.
  void learn(const VertexPool& pool, const Polygon& polygon);
  /// Gives the groups at pinches their own vertices.
  /// \param changed  the polygons that were learnt
  void split(Mesh& mesh, VertexPool& pool, const std::vector<int>& changed);
  /// The vertices given so far are kept for their places for good.
  void keep_all();
  /// No longer, if split() finds no use for them.
  void keep_none();

 private:
  struct Twins {
    std::vector<int> vertices;
    std::size_t kept = 0;
  };
  /// A polygon's corner at the pinch.
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

  std::vector<int> walls_;  // that begin at each vertex, its twins' included
  std::unordered_map<int, Twins> twins_;
  std::vector<int> suspects_;
  std::vector<Wedge> wedges_;
};

}  // namespace navvi_nav
