#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::bake {

/// Joins convex polygons that share an edge wherever the two together are convex, longest edges
/// first (after Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983). The result
/// covers the same points, and no corner of it lies on a straight edge.
/// \param max_corners  of a joined polygon
[[nodiscard]] std::vector<mesh::GridPolygon> merge_convex(std::vector<mesh::GridPolygon> polygons,
                                                          int max_corners);

}  // namespace navvi_nav::bake
