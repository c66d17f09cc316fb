#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "mesh/box_grid.hpp"
#include "mesh/mesh.hpp"

namespace navvi_nav {

/// Shortest paths by brute force, to judge searches by: every pair of wall ends is tried against
/// every wall on the way. Of a mesh it takes only its polygons' outlines and which of their edges
/// are portals.
class VisibilityGraph {
 public:
  explicit VisibilityGraph(const mesh::Mesh& mesh);

  /// m; none if there is no way. \param start, goal  points of the mesh
  [[nodiscard]] std::optional<double> distance(const mesh::Mesh::Place& start,
                                               const mesh::Mesh::Place& goal) const {
    const double found = distances({start, goal})[1][0];
    return found < kNoWay ? std::optional(found) : std::nullopt;
  }
  static constexpr double kNoWay = std::numeric_limits<double>::infinity();
  /// m, from each place to each of those before it, or kNoWay.
  [[nodiscard]] std::vector<std::vector<double>> distances(
      const std::vector<mesh::Mesh::Place>& places) const;
  /// True if nothing stands between two points of the mesh. Along a wall is free, between two walls
  /// that touch is not.
  [[nodiscard]] bool visible(Point a, Point b) const;

 private:
  struct Wall {
    Point from;  ///< the floor lies on the left
    Point to;
  };
  struct Node {
    Point at;
    int vertex = 0;
    std::vector<std::pair<int, double>> seen;
  };
  [[nodiscard]] bool inside(Point point) const;
  /// True if a path that begins at the vertex in this direction begins on its side of a
  /// non-manifold vertex.
  [[nodiscard]] bool leaves(int vertex, Point direction) const;
  [[nodiscard]] bool sees(const Node& a, const Node& b) const;
  [[nodiscard]] std::vector<double> reach(Point from) const;
  [[nodiscard]] std::vector<double> by_nodes(std::vector<double> best) const;

  const mesh::Mesh& mesh_;
  std::vector<Wall> walls_;
  mesh::BoxGrid wall_grid_, polygon_grid_;
  std::vector<std::vector<int>> around_;  ///< of each vertex, polygons
  std::vector<Node> nodes_;
};

}  // namespace navvi_nav
