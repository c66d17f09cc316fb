#include "navvi_floor/resample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_floor {
namespace {

constexpr double kRounding = 1e-4;      // of a cell
constexpr double kSpare = 0.06 + 1e-9;  // m

int floor_cell(double value) { return static_cast<int>(std::floor(value + kRounding)); }
int ceil_cell(double value) { return static_cast<int>(std::ceil(value - kRounding)); }

/// The squares [from, to) that a cell overlaps along one axis.
struct Overlap {
  int from = 0;
  int to = 0;
};

std::vector<Overlap> overlaps(int low, int count, double cell, double origin, double square) {
  std::vector<Overlap> out;
  out.reserve(static_cast<std::size_t>(count));
  for (int at = low; at < low + count; ++at)
    out.push_back({floor_cell((at * cell - origin) / square),
                   ceil_cell(((at + 1) * cell - origin) / square)});
  return out;
}

Ground worst(const GroundGrid& grid, Overlap across, Overlap along) {
  bool partial =
      across.from < 0 || along.from < 0 || across.to > grid.columns || along.to > grid.rows;
  for (int y = std::max(0, along.from); y < std::min(along.to, grid.rows); ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.columns);
    for (int x = std::max(0, across.from); x < std::min(across.to, grid.columns); ++x) {
      const Ground ground = grid.ground[row + static_cast<std::size_t>(x)];
      if (ground == Ground::obstacle) return ground;
      partial = partial || ground == Ground::none;
    }
  }
  return partial ? Ground::none : Ground::floor;
}

bool on_lattice(double place, double cell) {
  return std::abs(std::remainder(place, cell)) < kRounding * cell;
}

/// m: the squares' own size, or a whole part of it if a robot that needs `margin` to each side
/// could not pass where there is kSpare more. Whole cells lose up to one cell, what the margin is
/// rounded up by on either side, and another cell where the squares lie across the lattice.
double cell_that_keeps_ways_open(const GroundGrid& grid, double margin) {
  if (margin <= 0.0) return grid.cell_size;
  double best = grid.cell_size;
  double least = std::numeric_limits<double>::infinity();
  for (int parts = 1; static_cast<double>(grid.columns) * grid.rows * parts * parts <= kMaxCells;
       ++parts) {
    const double cell = grid.cell_size / parts;
    const bool aligned = on_lattice(grid.origin.x, cell) && on_lattice(grid.origin.y, cell);
    const double rounded = std::ceil(margin / cell - kRounding) * cell - margin;
    const double lost = (aligned ? cell : 2.0 * cell) + 2.0 * rounded;
    if (lost < least) best = cell;
    least = std::min(least, lost);
    if (least <= kSpare) break;
  }
  return best;
}

}  // namespace

MapSurvey resample(const GroundGrid& grid, const SurveyConfig& how) {
  double cell_size =
      how.cell_size > 0.0 ? how.cell_size : cell_that_keeps_ways_open(grid, how.margin);
  const double squares = static_cast<double>(grid.columns) * grid.rows;
  if (how.most_cells < kMaxCells)
    cell_size *= std::max(1.0, std::ceil(std::sqrt(squares / how.most_cells)));
  MapSurvey out;
  out.cell_size = cell_size;
  const Point high = grid.origin + grid.cell_size * Point{static_cast<double>(grid.columns),
                                                          static_cast<double>(grid.rows)};
  const double reach = std::max({-grid.origin.x, -grid.origin.y, high.x, high.y});
  if (reach > kFarthestMap) {
    out.error =
        "the map reaches " + std::to_string(std::llround(std::min(reach, 1e9) / 1000.0)) +
        " km from the origin of map; at most 10 km are allowed, so choose an origin near it";
    return out;
  }
  const double x = grid.origin.x / cell_size;
  const double y = grid.origin.y / cell_size;
  const double ratio = grid.cell_size / cell_size;
  if (grid.columns * ratio * grid.rows * ratio > kMaxCells) {
    out.error = "the map has more than " + millions(kMaxCells) + " cells of " +
                std::to_string(cell_size) + " m";
    return out;
  }
  out.low = {floor_cell(x), floor_cell(y)};
  out.columns = ceil_cell(x + grid.columns * ratio) - out.low.x;
  out.rows = ceil_cell(y + grid.rows * ratio) - out.low.y;
  const bool same = std::abs(ratio - 1.0) * std::max(grid.columns, grid.rows) < kRounding &&
                    out.columns == grid.columns && out.rows == grid.rows;
  if (same) {
    out.ground = {out.columns, out.rows, grid.ground.data()};
    return out;
  }
  const auto across = overlaps(out.low.x, out.columns, cell_size, grid.origin.x, grid.cell_size);
  const auto along = overlaps(out.low.y, out.rows, cell_size, grid.origin.y, grid.cell_size);
  out.ground = {out.columns, out.rows};
  for (int y = 0; y < out.rows; ++y) {
    Ground* row = out.ground.own_row(y);
    for (const Overlap& columns : across)
      *row++ = worst(grid, columns, along[static_cast<std::size_t>(y)]);
  }
  return out;
}

}  // namespace navvi_floor
