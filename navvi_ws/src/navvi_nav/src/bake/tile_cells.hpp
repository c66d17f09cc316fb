#pragma once

#include <cstdint>
#include <navvi_floor/floor.hpp>
#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::bake {

constexpr int kBorder = 1;  ///< cells around a tile that are looked at, too

/// The open cells of one square tile.
struct TileCells {
  map::Cell origin;  ///< lower cell
  int size = 0;      ///< cells along a side
  /// Row by row, 1: open. A border of one cell around the tile is looked at too: (size + 2)^2.
  std::vector<std::uint8_t> open;
  /// Parts of the tile, smallest_part(size) cells wide, of which finer cells are known: those
  /// count.
  std::vector<TileCells> fine;

  /// \param x, y  from the tile's lower cell; the border's, too
  [[nodiscard]] bool is_open(int x, int y) const {
    return open[static_cast<std::size_t>((y + kBorder) * (size + 2 * kBorder) + x + kBorder)] != 0;
  }
  /// Of the tile, its border left out.
  [[nodiscard]] std::int64_t count_open() const {
    std::int64_t count = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) count += is_open(x, y);
    return count;
  }
  [[nodiscard]] bool operator==(const TileCells& other) const {
    return origin.x == other.origin.x && origin.y == other.origin.y && size == other.size &&
           open == other.open && fine == other.fine;
  }
};

struct BakeConfig {
  double contour_error = 1.0;  ///< cells by which a wall may be drawn nearer to smooth it
  int max_edge = 0;            ///< cells, longer walls are split; 0: never
  int max_corners = 12;        ///< of a polygon, 3 to 12
  bool watershed = false;      ///< regions by Recast's watershed; else its layers, rows of cells
  int merge_region = 400;      ///< cells, smaller watershed regions join a neighbour
  int grow = 0;                ///< steps, at most half a cell: every wall moves out by so much
};

/// In steps of map, and counter-clockwise.
/// \param clockwise  corners, in steps from the tile's origin
template <typename Corners>
mesh::GridPolygon placed(const Corners& clockwise, const TileCells& cells) {
  mesh::GridPolygon out;
  out.corners.reserve(clockwise.size());
  for (auto corner = clockwise.rbegin(); corner != clockwise.rend(); ++corner)
    out.corners.push_back({cells.origin.x * map::kStepsPerCellSide + corner->x,
                           cells.origin.y * map::kStepsPerCellSide + corner->y});
  return out;
}

}  // namespace navvi_nav::bake
