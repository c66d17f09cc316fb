#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav {

/// A floor plan of square cells, of which each is free, blocked, or free in the half below one of
/// its diagonals; and meshes of it. What a mesh is tested with that needs no map.
class GridWorld {
 public:
  enum class CellKind : std::uint8_t { free, blocked, lower_left, lower_right };

  GridWorld(int columns, int rows);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  void fill(int x, int y, int width, int height, CellKind kind = CellKind::blocked);

  /// Convex polygons of all free cells. Rectangles as large as they come, in an order that the seed
  /// chooses, some of them split: their corners lie on other ones' edges, and on straight edges.
  [[nodiscard]] std::vector<mesh::GridPolygon> polygons(std::uint32_t seed) const;
  /// A place in the middle of a cell, on its border or in its corner, in cells; or on the diagonal.
  [[nodiscard]] Point somewhere(std::mt19937& random) const;

 private:
  [[nodiscard]] CellKind& at(int x, int y) {
    return cells_[static_cast<std::size_t>(y * columns_ + x)];
  }
  [[nodiscard]] CellKind at(int x, int y) const {
    return cells_[static_cast<std::size_t>(y * columns_ + x)];
  }

  int columns_;
  int rows_;
  std::vector<CellKind> cells_;
};

/// The families of worlds that searches are tested in.
enum class WorldKind {
  warehouse,  ///< shelves of one size in rows: very many routes of equal length
  clutter,    ///< boxes and slanted walls anywhere, touching and overlapping
  maze,       ///< dead ends and islands
  crumbs,     ///< single cells, many of which touch in a corner
  splinters,  ///< single cells and halves: corners that touch, round one of which a way can turn
};

[[nodiscard]] GridWorld grid_world(WorldKind kind, std::uint32_t seed);

}  // namespace navvi_nav
