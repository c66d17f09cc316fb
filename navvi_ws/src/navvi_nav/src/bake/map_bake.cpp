#include "bake/map_bake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/fine_parts.hpp"
#include "bake/merge_convex.hpp"
#include "map/parallel.hpp"

namespace navvi_nav::bake {
namespace {

constexpr int kLeastTile = 8;        // cells
constexpr int kMaxTileCells = 1024;  // Recast's corners have 16 bits, each cell 16 steps
constexpr int kLargestPart = 320;    // cells

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

/// Cells along a tile's side: 8 to 15, and that doubled, so that tiles can be quartered.
int tile_cells_of(double wanted) {
  double part = std::clamp(wanted, 1.0 * kLeastTile, 1.0 * kMaxTileCells);
  int times = 1;
  for (; part >= 2 * kLeastTile; part /= 2) times *= 2;
  return static_cast<int>(std::lround(part)) * times;
}

/// Cells along the side of the parts in which a tile is baked: its quarters, or quarters of these.
int part_of(int tile_cells) {
  while (tile_cells > kLargestPart) tile_cells /= 2;
  return tile_cells;
}

/// One tile on its way.
struct Work {
  TileIndex tile;
  const TileParts* before;
  TileParts parts;
  std::vector<mesh::GridPolygon> polygons;
};

TileCells cells_of(const map::Floor& floor, map::Cell low, int size, const MapBakeConfig& config) {
  TileCells out{low, size, {}, {}};
  const auto side = static_cast<std::size_t>(size) + 2;
  out.open.assign(side * side, 0);
  const map::Area known = clipped(map::grown({low, {low.x + size, low.y + size}}, 1), floor.area());
  for (int y = known.low.y; y < known.high.y && known.columns() > 0; ++y)
    std::copy_n(floor.open_row(y) + (known.low.x - floor.origin().x), known.columns(),
                out.open.begin() + static_cast<std::ptrdiff_t>(side) * (y - low.y + 1) +
                    (known.low.x - low.x + 1));
  if (config.fine_parts) add_fine_parts(out, floor, config.margin);
  return out;
}

/// Of all that a part's cells depend on: what lies around it, too, eroded.
bool changed_around(const map::Floor& floor, const map::Area& part, const MapBakeConfig& config) {
  return floor.changed(
      map::grown(part, 2 * kLeastTile + static_cast<int>(config.margin / floor.cell_size()) + 8));
}

}  // namespace

BakedMap bake_map(map::MapSurvey survey, const MapBakeConfig& config, const BakedMap* before) {
  BakedMap out;
  out.error = survey.error;
  if (!out.error.empty()) return out;
  const double cell = survey.cell_size;
  const std::string levels = std::move(survey.levels);
  out.record = std::move(survey.record);
  if (config.margin > (map::Floor::kMaxReach - 2) * cell) {
    out.error = "the robot is too wide for a map with cells of " + std::to_string(cell) +
                " m: its radius must not be more than " +
                std::to_string(map::Floor::kMaxReach - 2) + " cells";
    return out;
  }
  out.floor = std::make_shared<const map::Floor>(
      survey.low, survey.columns, survey.rows, cell, survey.floor_height, std::move(survey.ground),
      config.margin + config.reach, config.margin, config.threads,
      before != nullptr ? before->floor.get() : nullptr);
  const map::Floor& floor = *out.floor;
  const int size = tile_cells_of(config.tile_size / cell);
  const int part = part_of(size);
  const int aside = size / part, parts = aside * aside;
  out.tile_cells = size;
  const bool comparable = before != nullptr && before->floor && before->tile_cells == size &&
                          before->floor->cell_size() == cell &&
                          before->floor->grow() == floor.grow();
  static const BakedMap kNone;
  const BakedMap& last = comparable ? *before : kNone;
  std::vector<Work> works;
  for (int y = floor_div(floor.origin().y, size); y * size < floor.area().high.y; ++y) {
    for (int x = floor_div(floor.origin().x, size); x * size < floor.area().high.x; ++x) {
      const auto old = last.parts.find({x, y});
      works.push_back({{x, y},
                       old != last.parts.end() ? &old->second : nullptr,
                       TileParts(static_cast<std::size_t>(parts)),
                       {}});
    }
  }
  const BakeConfig how = tile_config(config, floor);
  map::in_parallel(static_cast<int>(works.size()) * parts, config.threads, [&](int i) {
    Work& work = works[static_cast<std::size_t>(i / parts)];
    const auto at = static_cast<std::size_t>(i % parts);
    const map::Cell low{work.tile.first * size + i % aside * part,
                        work.tile.second * size + i % parts / aside * part};
    work.parts[at] = work.before != nullptr ? (*work.before)[at] : nullptr;
    const bool same = work.before != nullptr &&
                      !changed_around(floor, {low, {low.x + part, low.y + part}}, config);
    if (same) return;
    const TileCells cells = cells_of(floor, low, part, config);
    if (work.before != nullptr && cells == cells_of(*last.floor, low, part, config)) return;
    work.parts[at] = std::make_shared<const std::vector<mesh::GridPolygon>>(bake_tile(cells, how));
  });
  map::in_parallel(static_cast<int>(works.size()), config.threads, [&](int i) {
    Work& work = works[static_cast<std::size_t>(i)];
    const auto old = last.tiles.find(work.tile);
    if (work.before != nullptr && work.parts == *work.before) {
      if (old != last.tiles.end()) work.polygons = old->second;
      return;
    }
    for (const auto& polygons : work.parts)
      work.polygons.insert(work.polygons.end(), polygons->begin(), polygons->end());
    if (config.max_corners > 3)
      work.polygons = merge_convex(std::move(work.polygons), config.max_corners);
  });
  for (Work& work : works) {
    const auto old = last.tiles.find(work.tile);
    if (old != last.tiles.end() ? work.polygons != old->second : !work.polygons.empty())
      out.rebuilt.push_back(work.tile);
    if (!work.polygons.empty()) out.tiles.emplace(work.tile, std::move(work.polygons));
    out.parts.emplace(work.tile, std::move(work.parts));
  }
  if (out.tiles.empty()) {
    out.error = "the map shows no walkable floor";
    if (!levels.empty()) out.error += "; what there is of floor lies at " + levels;
  }
  for (const auto& [tile, polygons] : last.tiles)
    if (out.parts.count(tile) == 0) out.rebuilt.push_back(tile);
  return out;
}

}  // namespace navvi_nav::bake
