#include "bake/map_bake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/fine_parts.hpp"
#include "map/parallel.hpp"

namespace navvi_nav::bake {
namespace {

constexpr int kLeastTile = 8;        // cells
constexpr int kMaxTileCells = 1024;  // Recast's corners have 16 bits, each cell 16 steps

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

BakeConfig tile_config(const MapBakeConfig& config, const map::Floor& floor) {
  const double cell = floor.cell_size();
  BakeConfig out;
  out.contour_error = config.contour_error;
  out.max_edge = static_cast<int>(config.max_edge / cell);
  out.max_corners = config.max_corners;
  out.merge_region = static_cast<int>(1.0 / (cell * cell));
  out.grow = floor.grow();
  return out;
}

/// One tile on its way; no polygons and not baked: nothing there.
struct Work {
  TileIndex tile;
  bool taken_over = false;
  std::vector<mesh::GridPolygon> polygons;
};

/// Cells along a tile's side: 8 to 15, and that doubled, so that tiles can be quartered.
int tile_cells_of(double wanted) {
  double part = std::clamp(wanted, 1.0 * kLeastTile, 1.0 * kMaxTileCells);
  int times = 1;
  for (; part >= 2 * kLeastTile; part /= 2) times *= 2;
  return static_cast<int>(std::lround(part)) * times;
}

TileCells cells_of(const map::Floor& floor, TileIndex tile, int tile_cells,
                   const MapBakeConfig& config) {
  TileCells out{{tile.first * tile_cells, tile.second * tile_cells}, tile_cells, {}, {}};
  const auto side = static_cast<std::size_t>(tile_cells) + 2;
  out.open.assign(side * side, 0);
  const int from = std::max(out.origin.x - 1, floor.origin().x);
  const int to = std::min(out.origin.x + tile_cells + 1, floor.origin().x + floor.columns());
  for (std::size_t row = 0; row < side && from < to; ++row) {
    const int y = out.origin.y - 1 + static_cast<int>(row);
    if (y < floor.origin().y || y >= floor.origin().y + floor.rows()) continue;
    std::copy_n(
        floor.open_row(y) + (from - floor.origin().x), to - from,
        out.open.begin() + static_cast<std::ptrdiff_t>(row * side) + (from - out.origin.x + 1));
  }
  if (config.fine_parts) add_fine_parts(out, floor, config.margin);
  return out;
}

/// Of all that a tile's cells depend on: parts around it, too, eroded.
bool same_ground_around(const map::Floor& before, const map::Floor& floor, TileIndex tile, int size,
                        const MapBakeConfig& config) {
  const int around = 2 * kLeastTile + static_cast<int>(config.margin / floor.cell_size()) + 8;
  return floor.same_ground(before, {tile.first * size - around, tile.second * size - around},
                           {(tile.first + 1) * size + around, (tile.second + 1) * size + around});
}

}  // namespace

BakedMap bake_map(map::MapSurvey survey, const MapBakeConfig& config, const BakedMap* before) {
  BakedMap out;
  out.error = survey.error;
  if (!out.error.empty()) return out;
  const double cell = survey.cell_size;
  const std::string levels = std::move(survey.levels);
  if (config.margin > (map::Floor::kMaxReach - 2) * cell) {
    out.error = "the robot is too wide for a map with cells of " + std::to_string(cell) +
                " m: its radius must not be more than " +
                std::to_string(map::Floor::kMaxReach - 2) + " cells";
    return out;
  }
  out.floor = std::make_shared<const map::Floor>(
      survey.low, survey.columns, survey.rows, cell, survey.floor_height, std::move(survey.ground),
      config.margin + config.reach, config.margin, config.threads);
  const map::Floor& floor = *out.floor;
  const int size = tile_cells_of(config.tile_size / cell);
  out.tile_cells = size;
  std::vector<Work> works;
  for (int y = floor_div(floor.origin().y, size); y * size < floor.origin().y + floor.rows(); ++y) {
    for (int x = floor_div(floor.origin().x, size); x * size < floor.origin().x + floor.columns();
         ++x)
      works.push_back({{x, y}, false, {}});
  }
  const bool comparable = before != nullptr && before->floor && before->tile_cells == size &&
                          before->floor->cell_size() == cell &&
                          before->floor->grow() == floor.grow();
  const BakeConfig how = tile_config(config, floor);
  map::in_parallel(static_cast<int>(works.size()), config.threads, [&](int i) {
    Work& work = works[static_cast<std::size_t>(i)];
    if (comparable && same_ground_around(*before->floor, floor, work.tile, size, config)) {
      work.taken_over = true;
      return;
    }
    const TileCells cells = cells_of(floor, work.tile, size, config);
    work.taken_over = comparable && cells == cells_of(*before->floor, work.tile, size, config);
    if (!work.taken_over) work.polygons = bake_tile(cells, how);
  });
  for (Work& work : works) {
    if (work.taken_over) {
      const auto old = before->tiles.find(work.tile);
      if (old != before->tiles.end()) out.tiles.insert(*old);
      continue;
    }
    out.rebuilt.push_back(work.tile);
    if (!work.polygons.empty()) out.tiles.emplace(work.tile, std::move(work.polygons));
  }
  if (out.tiles.empty()) {
    out.error = "the map shows no walkable floor";
    if (!levels.empty()) out.error += "; what there is of floor lies at " + levels;
  }
  if (before != nullptr) {
    for (const auto& [tile, polygons] : before->tiles) {
      const bool looked_at =
          std::any_of(works.begin(), works.end(),
                      [tile = tile](const Work& work) { return work.tile == tile; });
      if (!looked_at) out.rebuilt.push_back(tile);
    }
  }
  return out;
}

}  // namespace navvi_nav::bake
