#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "navvi_nav/floor.hpp"
#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// One tile's height field and what Recast makes of it (R-NAV-1, R-NAV-3). First spans are added,
/// then settle() fixes the floor, then build() can be called as often as holes come and go.
class TileField {
 public:
  /// How Recast turns open cells into polygons.
  struct Contours {
    double max_error = 1.0;  ///< cells by which a contour may leave the open cells' border
    int max_edge = 0;        ///< cells, longer wall edges are split; 0: never
    int merge_region = 400;  ///< cells, smaller watershed regions join a neighbour
  };

  /// \param origin  lower cell of the tile \param size  cells along a side
  /// \param border  cells around the tile that are looked at too
  /// \param levels  number of voxel levels
  TileField(Cell origin, int size, int border, int levels, double cell_size, double level_height);
  ~TileField();
  TileField(TileField&&) noexcept;
  TileField& operator=(TileField&&) noexcept;

  [[nodiscard]] Cell origin() const { return origin_; }
  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] int border() const { return border_; }

  /// Occupied levels [bottom, top) in one column; the cell must lie in the tile or its border.
  void add_span(Cell cell, int bottom, int top);
  /// Adds, for each top in the tile with `headroom` free levels above, one to its level's count.
  void count_tops(int headroom, std::map<int, int>& counts) const;
  /// Takes `floor_top` as the floor, keeps what stands on it, and drops the height field.
  /// \returns the ground of the tile's cells (no border), row by row
  [[nodiscard]] std::vector<Ground> settle(int floor_top, int headroom);
  /// Watershed regions, contours and polygons of the cells for which `open` holds. Ear clipping
  /// is what Recast does, not a constrained Delaunay triangulation.
  [[nodiscard]] std::vector<GridPolygon> build(const std::function<bool(Cell)>& open,
                                               const Contours& contours);

 private:
  struct Recast;
  [[nodiscard]] std::vector<GridPolygon> triangulate(const Contours& contours);

  Cell origin_;
  int size_ = 0;
  int border_ = 0;
  double cell_size_ = 0.0;
  double level_height_ = 0.0;
  std::unique_ptr<Recast> recast_;
};

}  // namespace navvi_nav
