#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry.hpp"
#include "mesh/box_grid.hpp"

namespace navvi_nav::mesh {

struct Vertex {
  Point at;  ///< m, map
  /// A shortest path may turn here: a wall ends at it and the free angle around it is over 180
  /// degrees. A false "true" only costs time, a false "false" costs exactness.
  bool corner = false;
};

/// The part of an edge that a polygon shares with a neighbour, as seen when leaving the polygon:
/// the polygon's boundary runs counter-clockwise from right to left.
struct Portal {
  int to = 0;     ///< the neighbour, index into Mesh::polygons
  int right = 0;  ///< vertex
  int left = 0;   ///< vertex
};

/// A part of an edge; right and left as seen on the way across it, m.
struct Interval {
  Point right;
  Point left;
};

/// Convex; a polygon without corners is an empty slot.
struct Polygon {
  std::vector<int> corners;     ///< vertices, counter-clockwise; some may lie on a straight edge
  std::vector<Portal> portals;  ///< in counter-clockwise order
  int component = 0;            ///< polygons with the same component are connected, others are not
};

/// Where the robot's centre may be (R-NAV-3): graph G is its polygons and their portals.
struct Mesh {
  /// One for each place where polygons meet. Where groups of polygons touch in a point only, as
  /// between two obstacles that touch, each group has its own vertex there: a search keeps what it
  /// knows by vertex, and a path cannot pass from one group to the other.
  std::vector<Vertex> vertices;
  std::vector<Polygon> polygons;
  BoxGrid grid;  ///< of polygons, by their corners

  struct Place {
    int polygon = 0;
    Point point;
  };
  /// The point of the mesh nearest to `point`, at most `within` m away.
  /// \param component  if given, only polygons of this component
  [[nodiscard]] std::optional<Place> locate(Point point, double within,
                                            std::optional<int> component = std::nullopt) const;

  [[nodiscard]] Point at(int vertex) const { return vertices[static_cast<std::size_t>(vertex)].at; }
  [[nodiscard]] const Polygon& polygon(int index) const {
    return polygons[static_cast<std::size_t>(index)];
  }
  /// The corners of a polygon, m.
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

}  // namespace navvi_nav::mesh
