#include "bake/tile_bake.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "bake/merge_convex.hpp"
#include "bake/outline.hpp"
#include "bake/recast_polygons.hpp"

namespace navvi_nav::bake {
namespace {

constexpr int kCrowded = 400;  // corners
constexpr int kLeastPart = 8;  // cells

/// Rows of open cells, each as tall as it stays the same.
std::vector<mesh::GridPolygon> rectangles(const TileCells& cells) {
  std::vector<mesh::GridPolygon> out;
  std::vector<std::array<int, 3>> growing, next;  // from, to, first row
  const auto close = [&](const std::array<int, 3>& run, int row) {
    const auto at = [&](int x, int y) -> std::array<int, 2> {
      return {(cells.origin.x + x) * map::kStepsPerCellSide,
              (cells.origin.y + y) * map::kStepsPerCellSide};
    };
    out.push_back({{at(run[0], run[2]), at(run[1], run[2]), at(run[1], row), at(run[0], row)}});
  };
  for (int y = 0; y <= cells.size; ++y) {
    next.clear();
    for (int x = 0; y < cells.size && x < cells.size; ++x) {
      const auto row =
          static_cast<std::size_t>((y + kBorder) * (cells.size + 2 * kBorder) + kBorder);
      const int from = x;
      while (x < cells.size && cells.open[row + static_cast<std::size_t>(x)] != 0) ++x;
      if (x > from) next.push_back({from, x, y});
    }
    for (const auto& run : growing) {
      const auto same = std::find_if(next.begin(), next.end(), [&run](const auto& other) {
        return other[0] == run[0] && other[1] == run[1];
      });
      if (same != next.end()) {
        (*same)[2] = run[2];
      } else {
        close(run, y);
      }
    }
    growing.swap(next);
  }
  return out;
}

/// Recast draws no contour around a lone cell. They are taken out of `cells`, a square each.
std::vector<mesh::GridPolygon> take_lone_cells(TileCells& cells, int grow) {
  const int side = cells.size + 2 * kBorder;
  const auto open = [&](int x, int y) -> std::uint8_t& {
    return cells.open[static_cast<std::size_t>((y + kBorder) * side + x + kBorder)];
  };
  std::vector<map::Cell> lone;
  for (int y = 0; y < cells.size; ++y) {
    const std::uint8_t* row = &open(0, y);
    for (int x = 0; x < cells.size; ++x) {
      const int from = x;
      x = static_cast<int>(std::find(row + x, row + cells.size, std::uint8_t{0}) - row);
      if (x == from + 1 && !(y > 0 && row[from - side] != 0) &&
          !(y + 1 < cells.size && row[from + side] != 0))
        lone.push_back({from, y});
    }
  }
  std::vector<mesh::GridPolygon> out;
  for (const map::Cell& cell : lone) {
    std::vector<OutlineCorner> outline{{cell.x, cell.y, true},
                                       {cell.x, cell.y + 1, true},
                                       {cell.x + 1, cell.y + 1, true},
                                       {cell.x + 1, cell.y, true}};
    grow_walls(outline, cells, grow);
    out.push_back(placed(outline, cells));
  }
  for (const map::Cell& cell : lone) open(cell.x, cell.y) = 0;
  return out;
}

/// Corners of the open cells' border.
int count_corners(const TileCells& cells) {
  const int side = cells.size + 2 * kBorder;
  int count = 0;
  for (int y = 1; y < side; ++y) {
    const std::uint8_t* below = cells.open.data() + static_cast<std::size_t>((y - 1) * side);
    const std::uint8_t* above = below + side;
    std::uint16_t in_row = 0;  // narrow, for the compiler's vectors
    for (int x = 1; x < side; ++x) {
      const std::uint8_t under = below[x - 1] ^ below[x], over = above[x - 1] ^ above[x];
      const std::uint8_t corner = (under ^ over) | (under & over & (below[x] ^ above[x]));
      in_row = static_cast<std::uint16_t>(in_row + corner);
    }
    count += in_row;
  }
  return count;
}

TileCells part_of(const TileCells& cells, map::Cell low, int size) {
  TileCells out{{cells.origin.x + low.x, cells.origin.y + low.y}, size, {}, {}};
  const int side = cells.size + 2 * kBorder;
  for (int y = 0; y < size + 2 * kBorder; ++y) {
    const auto row = cells.open.begin() + (low.y + y) * side + low.x;
    out.open.insert(out.open.end(), row, row + size + 2 * kBorder);
  }
  const auto lies_in = [size](int fine, int parts, int from) {
    return fine >= from * parts && fine < (from + size) * parts;
  };
  for (const TileCells& fine : cells.fine) {
    const int parts = fine.size / smallest_part(cells.size);
    if (lies_in(fine.origin.x, parts, out.origin.x) && lies_in(fine.origin.y, parts, out.origin.y))
      out.fine.push_back(fine);
  }
  return out;
}

bool can_be_quartered(int size) { return size % 2 == 0 && size / 2 >= kLeastPart; }

void bake_part(const TileCells& cells, const BakeConfig& config,
               std::vector<mesh::GridPolygon>& out);

/// A smallest part, of which `fine` are the finer cells.
void bake_fine(const TileCells& fine, int parts, BakeConfig config,
               std::vector<mesh::GridPolygon>& out) {
  config.max_edge *= parts;
  config.merge_region *= parts * parts;
  config.grow = 0;
  const std::size_t before = out.size();
  bake_part(fine, config, out);
  for (std::size_t i = before; i < out.size(); ++i)
    for (std::array<int, 2>& corner : out[i].corners)
      for (int& steps : corner) steps /= parts;  // whole cells: a step of the tile, or some
}

/// Recast's work on one region grows with the cube of its corners, so crowded tiles are quartered.
void bake_part(const TileCells& cells, const BakeConfig& config,
               std::vector<mesh::GridPolygon>& out) {
  const int half = cells.size / 2;
  const bool fine = !cells.fine.empty();
  if (fine && !can_be_quartered(cells.size)) {
    bake_fine(cells.fine[0], cells.fine[0].size / cells.size, config, out);
    return;
  }
  if (can_be_quartered(cells.size) && (fine || count_corners(cells) > kCrowded)) {
    for (const map::Cell low :
         {map::Cell{0, 0}, map::Cell{half, 0}, map::Cell{0, half}, map::Cell{half, half}})
      bake_part(part_of(cells, low, half), config, out);
    return;
  }
  TileCells rest = cells;
  std::vector<mesh::GridPolygon> polygons = take_lone_cells(rest, config.grow);
  out.insert(out.end(), polygons.begin(), polygons.end());
  if (rest.count_open() == 0) return;
  const auto drawn = recast_polygons(cells, rest, config);
  polygons = drawn ? *drawn : rectangles(rest);
  out.insert(out.end(), polygons.begin(), polygons.end());
}

}  // namespace

int smallest_part(int size) {
  while (can_be_quartered(size)) size /= 2;
  return size;
}

std::vector<mesh::GridPolygon> bake_tile(const TileCells& cells, const BakeConfig& config) {
  std::vector<mesh::GridPolygon> out;
  bake_part(cells, config, out);
  if (config.max_corners <= 3) return out;
  return merge_convex(std::move(out), config.max_corners);
}

}  // namespace navvi_nav::bake
