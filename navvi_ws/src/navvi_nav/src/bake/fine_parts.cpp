#include "bake/fine_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <navvi_floor/pieces.hpp>
#include <utility>

namespace navvi_nav::bake {
namespace {

constexpr double kFinest = 0.0063;  // m, of a cell
constexpr double kRounding = 1e-6;  // cells
constexpr int kAround = 3;          // cells
constexpr int kAside = 2 * kAround + 1;

/// Parts of a cell's side, a power of two up to kStepsPerCellSide.
int parts_of(double cell) {
  int parts = 4;
  while (parts < map::kStepsPerCellSide && cell / parts > kFinest) parts *= 2;
  return parts;
}

/// Open cells around one, kAside x kAside, a bit each, row by row: none but at the rim, or several
/// pieces. A way that only parts of cells open has such a place: where none is, what is open near
/// one cell of it is joined to what is open near the next.
bool strait(std::uint64_t open) {
  constexpr std::uint64_t kLeft = 0x40810204081, kNear = 0x1f3e7cf9f00;  // first column; 5 x 5
  constexpr std::uint64_t kRight = kLeft << (kAside - 1);
  std::uint64_t piece = open & (~open + 1), before = 0;
  while (piece != before) {
    before = piece;
    piece |= (piece << kAside | piece >> kAside | (piece & ~kRight) << 1 | (piece & ~kLeft) >> 1) &
             open;
  }
  return (open & kNear) == 0 || piece != open;
}

std::uint64_t open_around(const map::Floor& floor, map::Cell cell) {
  const map::Area around = map::grown({cell, {cell.x + 1, cell.y + 1}}, kAround);
  const bool inside = clipped(around, floor.area()) == around;
  std::uint64_t open = 0;
  for (int y = around.high.y - 1; y >= around.low.y; --y) {
    const std::uint8_t* row = inside ? floor.open_row(y) - floor.origin().x : nullptr;
    for (int x = around.high.x - 1; x >= around.low.x; --x)
      open = open << 1 | (inside ? row[x] : static_cast<std::uint64_t>(floor.open({x, y})));
  }
  return open;
}

/// Squared cells: where nothing blocks within less, some point of the cell may keep the margin.
int least_gap2(double margin_cells) {
  const double least = std::max(0.0, margin_cells - std::sqrt(2.0));
  return static_cast<int>(std::ceil(least * least - kRounding));
}

/// For each part of the tile, row by row, whether it or the cells beside it hold such a place.
std::vector<char> wanted_parts(const map::Floor& floor, map::Cell origin, int size, int part,
                               double margin_cells) {
  const int side = size / part;
  const int least = least_gap2(margin_cells);
  std::vector<char> out(static_cast<std::size_t>(side * side), 0);
  const int from = std::max(origin.x - kAround, floor.origin().x);
  const int to = std::min(origin.x + size + kAround, floor.origin().x + floor.columns());
  const int last = std::min(origin.y + size + kAround, floor.origin().y + floor.rows());
  for (int y = std::max(origin.y - kAround, floor.origin().y); y < last; ++y) {
    const std::uint16_t* gap2 = floor.gap2_row(y) - floor.origin().x;
    const std::uint8_t* open = floor.open_row(y) - floor.origin().x;
    for (int x = from; x < to; ++x) {
      if (open[x] != 0 || gap2[x] < least || !strait(open_around(floor, {x, y}))) continue;
      for (int dy : {-kAround, kAround}) {
        for (int dx : {-kAround, kAround}) {
          const int column = x + dx - origin.x, row = y + dy - origin.y;
          if (column >= 0 && row >= 0 && column < size && row < size)
            out[static_cast<std::size_t>(row / part * side + column / part)] = 1;
        }
      }
    }
  }
  return out;
}

/// Runs of cells in a row that block, or that the map does not have, of those in [from, to).
std::vector<std::pair<int, int>> blocked_runs(const map::Floor& floor, int y, int from, int to) {
  std::vector<std::pair<int, int>> out;
  for (int x = from; x < to; ++x) {
    if (floor.ground({x, y}) == map::Ground::floor) continue;
    if (out.empty() || out.back().second != x) out.emplace_back(x, x);
    out.back().second = x + 1;
  }
  return out;
}

/// The open cells of a square, each 1 / `parts` of a floor's cell.
TileCells fine_cells(const map::Floor& floor, map::Cell low, int part, int parts, double margin) {
  TileCells out{{low.x * parts, low.y * parts}, part * parts, {}, {}};
  const int side = out.size + 2;
  out.open.assign(static_cast<std::size_t>(side * side), 1);
  const double reach = margin / floor.cell_size() * parts;
  const int cells = static_cast<int>(std::ceil(reach / parts)) + 1;
  for (int y = low.y - cells; y < low.y + part + cells; ++y) {
    const auto runs = blocked_runs(floor, y, low.x - cells, low.x + part + cells);
    if (runs.empty()) continue;
    for (int row = 0; row < side; ++row) {
      const int at = out.origin.y - 1 + row;
      const int dy = std::max({0, y * parts - (at + 1), at - (y + 1) * parts});
      const double left = reach * reach - static_cast<double>(dy) * dy - kRounding;
      if (left <= 0.0) continue;
      const int aside = static_cast<int>(std::ceil(std::sqrt(left)));  // cells that are too near
      const auto begin = out.open.begin() + static_cast<std::ptrdiff_t>(row) * side;
      for (const auto& [first, end] : runs) {
        const int from = std::max(0, first * parts - aside - out.origin.x + 1);
        const int to = std::min(side, end * parts + aside - out.origin.x + 1);
        if (from < to) std::fill(begin + from, begin + to, std::uint8_t{0});
      }
    }
  }
  return out;
}

/// A square's cells by what they belong to, numbered from 1 on; 0: to none.
struct Pieces {
  int side = 0;                      // fine cells
  int parts = 0;                     // of a whole cell's side
  std::vector<std::uint32_t> fine;   // pieces of the fine open cells
  std::vector<std::uint32_t> whole;  // whole cell by whole cell: of those that are open
  std::vector<std::uint32_t> exits;  // of the fine ones along the square's rim

  [[nodiscard]] std::uint32_t whole_at(int x, int y) const {
    return whole[static_cast<std::size_t>(y / parts * (side / parts) + x / parts)];
  }
};

Pieces pieces_in(const TileCells& fine, const map::Floor& floor, int parts) {
  const int side = fine.size;
  std::vector<std::uint8_t> open, whole;
  for (int y = 0; y < side; ++y) {
    const auto row = fine.open.begin() + (y + kBorder) * (side + 2 * kBorder) + kBorder;
    open.insert(open.end(), row, row + side);
  }
  for (int y = 0; y < side; y += parts)
    for (int x = 0; x < side; x += parts)
      whole.push_back(floor.open({(fine.origin.x + x) / parts, (fine.origin.y + y) / parts}));
  const auto pieces = [](const std::vector<std::uint8_t>& mask, int across) {
    const auto size = static_cast<std::size_t>(across);
    return map::pieces_of(size, size, 0, [&mask](std::size_t at) { return mask[at] != 0; });
  };
  Pieces out{side, parts, pieces(open, side), pieces(whole, side / parts), {}};
  for (int y = 1; y < side - 1; ++y)
    std::fill_n(open.begin() + y * side + 1, side - 2, std::uint8_t{0});
  out.exits = pieces(open, side);
  return out;
}

/// For each exit whether a whole open cell of its piece lies beside it. Then what is beyond is left
/// to the next square, which overlaps this one by two cells and so has both.
std::vector<char> exits_at_cells(const Pieces& of) {
  const int parts = of.parts;
  std::vector<char> out(of.exits.size() + 1, 0);
  for (int at = 0; at < of.side * of.side; ++at) {
    const auto i = static_cast<std::size_t>(at);
    if (of.exits[i] == 0) continue;
    for (const auto& [dx, dy] :
         {std::pair{0, 0}, {-parts, 0}, {parts, 0}, {0, -parts}, {0, parts}}) {
      const int x = at % of.side + dx, y = at / of.side + dy;
      if (x < 0 || y < 0 || x >= of.side || y >= of.side) continue;
      const auto beside = static_cast<std::size_t>(y * of.side + x);
      if (of.whole_at(x, y) != 0 && of.fine[beside] == of.fine[i])
        out[of.exits[i]] = 1;
    }
  }
  return out;
}

/// True if a piece of the fine cells joins two ends, whole cells or exits, that are apart without.
bool opens_a_way(const TileCells& fine, const map::Floor& floor, int parts) {
  const Pieces of = pieces_in(fine, floor, parts);
  const std::vector<char> at_cells = exits_at_cells(of);
  const auto cells = static_cast<std::uint32_t>(of.fine.size());
  std::vector<std::uint32_t> first(of.fine.size() + 1, 0);
  std::size_t at = 0;
  for (int y = 0; y < of.side; ++y) {
    for (int x = 0; x < of.side; ++x, ++at) {
      if (of.fine[at] == 0) continue;
      const std::uint32_t exit = of.exits[at];
      std::uint32_t end = of.whole_at(x, y);
      if (end == 0 && exit != 0 && at_cells[exit] == 0) end = cells + exit;
      if (end == 0) continue;
      std::uint32_t& known = first[of.fine[at]];
      if (known != 0 && known != end) return true;
      known = end;
    }
  }
  return false;
}

/// The square without its outermost cells, `by` fine ones wide.
TileCells shrunk(const TileCells& fine, int by) {
  TileCells out{{fine.origin.x + by, fine.origin.y + by}, fine.size - 2 * by, {}, {}};
  for (int y = -kBorder; y < out.size + kBorder; ++y)
    for (int x = -kBorder; x < out.size + kBorder; ++x)
      out.open.push_back(static_cast<std::uint8_t>(fine.is_open(x + by, y + by)));
  return out;
}

/// Cells of which a part is open: no wall of the cells beside them is there to be smoothed.
void mark_open(const TileCells& fine, int parts, TileCells& cells) {
  for (int y = 0; y < fine.size; ++y) {
    for (int x = 0; x < fine.size; ++x) {
      const int column = fine.origin.x / parts + x / parts - cells.origin.x + 1;
      const int row = fine.origin.y / parts + y / parts - cells.origin.y + 1;
      const int side = cells.size + 2;
      if (column >= 0 && row >= 0 && column < side && row < side)
        cells.open[static_cast<std::size_t>(row * side + column)] |=
            static_cast<std::uint8_t>(fine.is_open(x, y));
    }
  }
}

}  // namespace

void add_fine_parts(TileCells& cells, const map::Floor& floor, double margin) {
  const int part = smallest_part(cells.size);
  const int parts = parts_of(floor.cell_size());
  const int side = cells.size / part + 2;  // those around the tile, too
  const map::Cell low{cells.origin.x - part, cells.origin.y - part};
  const std::vector<char> wanted =
      wanted_parts(floor, low, side * part, part, margin / floor.cell_size());
  std::vector<TileCells> fine(wanted.size());
  std::vector<char> opens(wanted.size(), 0);
  for (std::size_t at = 0; at < wanted.size(); ++at) {
    if (wanted[at] == 0) continue;
    const auto n = static_cast<int>(at);
    // With a cell more around: open cells to either side of the part's border may be apart.
    const TileCells around = fine_cells(
        floor, {low.x + n % side * part - 1, low.y + n / side * part - 1}, part + 2, parts, margin);
    opens[at] = static_cast<char>(opens_a_way(around, floor, parts));
    fine[at] = shrunk(around, parts);
  }
  const auto row = static_cast<std::size_t>(side);
  for (std::size_t at = 0; at < wanted.size(); ++at) {
    if (wanted[at] == 0) continue;
    const std::size_t x = at % row, y = at / row;
    const bool around = x == 0 || y == 0 || x == row - 1 || y == row - 1;
    // A way that one part opens may lead a little through the next.
    if (!around &&
        (opens[at] | opens[at - 1] | opens[at + 1] | opens[at - row] | opens[at + row]) == 0)
      continue;
    mark_open(fine[at], parts, cells);
    if (!around) cells.fine.push_back(std::move(fine[at]));
  }
}

}  // namespace navvi_nav::bake
