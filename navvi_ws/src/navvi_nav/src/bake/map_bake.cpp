#include "bake/map_bake.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_floor/parallel.hpp>

#include "bake/fine_parts.hpp"
#include "bake/merge_convex.hpp"

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
  out.watershed = config.watershed;
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

/// How the map before is compared: by tiles of the same cells.
bool comparable(const BakedMap& before, const map::Floor& floor, int tile_cells) {
  return before.floor && before.tile_cells == tile_cells &&
         before.floor->cell_size() == floor.cell_size() && before.floor->grow() == floor.grow();
}

/// The tiles of one map on their way: baked part by part, then merged across the parts' borders.
class Tiles {
 public:
  /// \param tile_cells  along a tile's side \param last  the map before; empty: not to be compared
  Tiles(const map::Floor& floor, int tile_cells, const MapBakeConfig& config, const BakedMap& last)
      : floor_(floor),
        config_(config),
        how_(tile_config(config, floor)),
        last_(last),
        part_(part_of(tile_cells)),
        aside_(tile_cells / part_) {
    const map::Area all = floor.area();
    for (int y = floor_div(all.low.y, tile_cells); y * tile_cells < all.high.y; ++y)
      for (int x = floor_div(all.low.x, tile_cells); x * tile_cells < all.high.x; ++x) add({x, y});
  }

  void bake_parts() {
    const int parts = aside_ * aside_;
    map::in_parallel(static_cast<int>(tiles_.size()) * parts, config_.threads, [&](int i) {
      bake_part(tiles_[static_cast<std::size_t>(i / parts)], i % parts);
    });
  }
  void merge_parts() {
    map::in_parallel(static_cast<int>(tiles_.size()), config_.threads,
                     [&](int i) { merge(tiles_[static_cast<std::size_t>(i)]); });
  }
  void move_to(BakedMap& out) {
    for (Tile& tile : tiles_) {
      const auto old = last_.tiles.find(tile.index);
      if (old != last_.tiles.end() ? tile.polygons != old->second : !tile.polygons.empty())
        out.rebuilt.push_back(tile.index);
      if (!tile.polygons.empty()) out.tiles.emplace(tile.index, std::move(tile.polygons));
      out.parts.emplace(tile.index, std::move(tile.parts));
    }
    for (const auto& [index, polygons] : last_.tiles)
      if (out.parts.count(index) == 0) out.rebuilt.push_back(index);
  }

 private:
  struct Tile {
    TileIndex index;
    const TileParts* before;  ///< null: none
    TileParts parts;
    std::vector<mesh::GridPolygon> polygons;
  };

  void add(TileIndex index) {
    const auto old = last_.parts.find(index);
    tiles_.push_back({index,
                      old != last_.parts.end() ? &old->second : nullptr,
                      TileParts(static_cast<std::size_t>(aside_ * aside_)),
                      {}});
  }
  /// \param i  number of the part, row by row
  void bake_part(Tile& tile, int i) {
    auto& baked = tile.parts[static_cast<std::size_t>(i)];
    const map::Cell low{(tile.index.first * aside_ + i % aside_) * part_,
                        (tile.index.second * aside_ + i / aside_) * part_};
    if (tile.before != nullptr) {
      baked = (*tile.before)[static_cast<std::size_t>(i)];
      if (!changed_around(floor_, {low, {low.x + part_, low.y + part_}}, config_)) return;
    }
    const TileCells cells = cells_of(floor_, low, part_, config_);
    if (tile.before != nullptr && cells == cells_of(*last_.floor, low, part_, config_)) return;
    baked = std::make_shared<const std::vector<mesh::GridPolygon>>(bake_tile(cells, how_));
  }
  void merge(Tile& tile) {
    if (tile.before != nullptr && tile.parts == *tile.before) {
      const auto old = last_.tiles.find(tile.index);
      if (old != last_.tiles.end()) tile.polygons = old->second;
      return;
    }
    for (const auto& polygons : tile.parts)
      tile.polygons.insert(tile.polygons.end(), polygons->begin(), polygons->end());
    if (config_.max_corners > 3)
      tile.polygons = merge_convex(std::move(tile.polygons), config_.max_corners);
  }

  const map::Floor& floor_;
  const MapBakeConfig& config_;
  const BakeConfig how_;
  const BakedMap& last_;
  const int part_;   // cells along a part's side
  const int aside_;  // parts along a tile's side
  std::vector<Tile> tiles_;
};

std::string too_wide_for(double cell) {
  const std::string most = std::to_string(map::Floor::kMaxReach - 2);
  return "the robot is too wide for a map with cells of " + std::to_string(cell) +
         " m: its radius must not be more than " + most + " cells";
}

std::string no_floor(const std::string& levels) {
  const std::string sentence = "the map shows no walkable floor";
  return levels.empty() ? sentence : sentence + "; what there is of floor lies at " + levels;
}

}  // namespace

BakedMap bake_map(map::MapSurvey survey, const MapBakeConfig& config, const BakedMap* before) {
  BakedMap out;
  const double cell = survey.cell_size;
  out.error = std::move(survey.error);
  if (out.error.empty() && config.margin > (map::Floor::kMaxReach - 2) * cell)
    out.error = too_wide_for(cell);
  if (!out.error.empty()) return out;
  out.record = std::move(survey.record);
  out.floor = std::make_shared<const map::Floor>(
      map::FloorGround{survey.low, cell, survey.floor_height, std::move(survey.ground)},
      map::FloorDistances{config.margin + config.reach, config.margin}, config.threads,
      before != nullptr ? before->floor.get() : nullptr);
  out.tile_cells = tile_cells_of(config.tile_size / cell);
  static const BakedMap kNone;
  const bool compared = before != nullptr && comparable(*before, *out.floor, out.tile_cells);
  Tiles tiles(*out.floor, out.tile_cells, config, compared ? *before : kNone);
  tiles.bake_parts();
  tiles.merge_parts();
  tiles.move_to(out);
  if (out.tiles.empty()) out.error = no_floor(survey.levels);
  return out;
}

}  // namespace navvi_nav::bake
