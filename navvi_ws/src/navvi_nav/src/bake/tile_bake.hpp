#pragma once

#include <vector>

#include "bake/tile_cells.hpp"

namespace navvi_nav::bake {

/// Cells along the side of a tile that was quartered as often as it can be; 8 at least.
[[nodiscard]] int smallest_part(int size);

/// What Recast makes of a tile (R-NAV-3): regions, contours, convex polygons. (Recast
/// cuts ears and merges, it makes no constrained Delaunay triangulation.)
///
/// No point of the polygons lies outside the open cells, each grown by `grow`: contours follow the
/// cells exactly, and are then smoothed only by filling notches, one side of a wall at a time. That
/// the polygons cover each point once follows from two exact sums. The outlines of all regions
/// together enclose the tile's open cells once, for between two regions both outlines run along the
/// same line. Filling notches takes area away, and what is taken twice would count as negative.
/// So if every polygon is convex and turns left, and their areas sum up to that of the outlines, no
/// point is covered twice or wrongly. Tiles for which Recast fails this are covered by rectangles.
///
/// Neighbouring tiles meet exactly: on the tile's border every corner is where open and blocked
/// cells meet, or on the straight line between.
[[nodiscard]] std::vector<mesh::GridPolygon> bake_tile(const TileCells& cells,
                                                       const BakeConfig& config);

}  // namespace navvi_nav::bake
