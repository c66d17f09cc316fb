#pragma once

#include <cstdint>
#include <vector>

#include "map/floor.hpp"
#include "mesh/mesh.hpp"

namespace navvi_nav::bake {

/// The open cells of one square tile.
struct TileCells {
  map::Cell origin;  ///< lower cell
  int size = 0;      ///< cells along a side
  /// Row by row, 1: open. A border of one cell around the tile is looked at too: (size + 2)^2.
  std::vector<std::uint8_t> open;
  /// Parts of the tile, smallest_part(size) cells wide, of which finer cells are known: those
  /// count.
  std::vector<TileCells> fine;

  [[nodiscard]] bool operator==(const TileCells& other) const {
    return origin.x == other.origin.x && origin.y == other.origin.y && size == other.size &&
           open == other.open && fine == other.fine;
  }
};

/// Cells along the side of a tile that was quartered as often as it can be; 8 at least.
[[nodiscard]] int smallest_part(int size);

struct BakeConfig {
  double contour_error = 1.0;  ///< cells by which a wall may be drawn nearer to smooth it
  int max_edge = 0;            ///< cells, longer walls are split; 0: never
  int max_corners = 12;        ///< of a polygon, 3 to 12
  int merge_region = 400;      ///< cells, smaller watershed regions join a neighbour
  int grow = 0;                ///< steps, at most half a cell: every wall moves out by so much
};

/// What Recast makes of a tile (R-NAV-3): watershed regions, contours, convex polygons. (Recast
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
