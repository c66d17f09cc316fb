#pragma once

#include <array>
#include <optional>
#include <vector>

#include "navvi_nav/box_grid.hpp"
#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

struct Vertex {
  Point at;  ///< m, map
  /// A shortest path may turn here: a wall ends at it and the free angle around it is over 180
  /// degrees. A false "true" only costs time, a false "false" costs exactness.
  bool corner = false;
};

/// The way from a polygon into its neighbour: the part of the edge that both share. Right and left
/// are vertices, as seen when leaving: the polygon's boundary runs counter-clockwise from right to
/// left.
struct Link {
  int to = 0;  ///< index into Mesh::polygons
  int right = 0;
  int left = 0;
};

/// Convex; a polygon without corners is an empty slot.
struct Polygon {
  std::vector<int> corners;  ///< vertices, counter-clockwise; some may lie on a straight edge
  std::vector<Link> links;   ///< in counter-clockwise order
  int part = 0;              ///< polygons with the same part are connected, others are not
};

/// Where the robot's centre may be (R-NAV-3): graph G is its polygons and their links.
struct Mesh {
  /// One for each place where polygons meet; but where they meet in a point only, as two obstacles
  /// that touch leave them, each group that links join has its own. A search knows a vertex by its
  /// number: were it shared, what is known of one side would be taken for the other's.
  std::vector<Vertex> vertices;
  std::vector<Polygon> polygons;
  BoxGrid grid;  ///< of polygons, by their corners

  struct Place {
    int polygon = 0;
    Point point;
  };
  /// The point of the mesh nearest to `point`, at most `within` m away.
  /// \param part  if given, only polygons of this part
  [[nodiscard]] std::optional<Place> locate(Point point, double within,
                                            std::optional<int> part = std::nullopt) const;

  [[nodiscard]] Point at(int vertex) const { return vertices[static_cast<std::size_t>(vertex)].at; }
  [[nodiscard]] const Polygon& polygon(int index) const {
    return polygons[static_cast<std::size_t>(index)];
  }
  /// The corners of a polygon in their places.
  [[nodiscard]] std::vector<Point> outline(int polygon) const;
  /// The angle at a corner inside a polygon, rad. \param k  number of the corner in the polygon
  [[nodiscard]] double angle_at(const Polygon& polygon, std::size_t k) const;
  /// Centre of a polygon's area.
  [[nodiscard]] Point centroid(int polygon) const;
};

/// A convex polygon's corners in cell borders, (0, 0) at the origin of map: exact, so that
/// neighbours match without a tolerance. Counter-clockwise; some may lie on a straight edge.
struct GridPolygon {
  std::vector<std::array<int, 2>> corners;
};

inline bool operator==(const GridPolygon& a, const GridPolygon& b) {
  return a.corners == b.corners;
}

/// The mesh of `polygons`. Two of them are linked where their edges overlap over some length,
/// whether or not they share corners; where a link ends within an edge, its vertex is made a corner
/// of the polygon. So each edge between two following corners is a link or a wall, whole.
[[nodiscard]] Mesh join(const std::vector<GridPolygon>& polygons, double cell_size);

}  // namespace navvi_nav
