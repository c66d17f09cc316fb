#pragma once

#include <array>
#include <optional>
#include <vector>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

/// The way from a triangle into its neighbour: the part of the edge that both share. Left and
/// right as seen when leaving the triangle.
struct Link {
  int to = 0;  ///< index into Mesh::triangles
  Point left;
  Point right;
};

struct Triangle {
  std::array<Point, 3> corners;  ///< counter-clockwise, m, map
  std::vector<Link> links;
  int part = 0;  ///< triangles with the same part are connected, others are not

  [[nodiscard]] Point centroid() const;
  /// Borders count as inside.
  [[nodiscard]] bool contains(Point point) const;
  [[nodiscard]] Point nearest(Point point) const;
};

/// Where the robot's centre may be (R-NAV-3): graph G is its triangles and their links.
struct Mesh {
  std::vector<Triangle> triangles;

  struct Place {
    int triangle = 0;
    Point point;
  };
  /// The point of the mesh nearest to `point`, at most `within` m away.
  /// \param part  if given, only triangles of this part
  [[nodiscard]] std::optional<Place> locate(Point point, double within,
                                            std::optional<int> part = std::nullopt) const;
};

/// A triangle's corners in cell borders, (0, 0) at the origin of map: exact, so that neighbours
/// match without a tolerance.
struct GridTriangle {
  std::array<std::array<int, 2>, 3> corners;  ///< counter-clockwise
};

inline bool operator==(const GridTriangle& a, const GridTriangle& b) {
  return a.corners == b.corners;
}

/// The mesh of `triangles`. Two triangles are linked where their edges overlap over some length,
/// whether or not they share corners.
[[nodiscard]] Mesh join(const std::vector<GridTriangle>& triangles, double cell_size);

}  // namespace navvi_nav
