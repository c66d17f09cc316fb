#include "navvi_nav/map_survey.hpp"

namespace navvi_nav {
namespace {

constexpr int kBorder = 4;  // cells looked at around a tile, so that neighbours agree
constexpr int kMinTileCells = 16;
constexpr int kMaxLevels = 8000;      // Recast's spans have 13 bits
constexpr double kMaxCells = 64.0e6;  // of the whole map
constexpr double kRounding = 1e-4;    // cells

int floor_cell(double value) { return static_cast<int>(std::floor(value + kRounding)); }
int ceil_cell(double value) { return static_cast<int>(std::ceil(value - kRounding)); }
int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// A leaf in cells and levels, upper ends excluded.
struct Block {
  int x0, x1, y0, y1, bottom, top;
};

/// The occupied space, m.
struct Extent {
  double low[3] = {1e9, 1e9, 1e9};
  double high[3] = {-1e9, -1e9, -1e9};
};

template <typename Visit>
void for_each_occupied(const octomap::OcTree& tree, Visit visit) {
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (tree.isNodeOccupied(*leaf))
      visit(leaf.getX(), leaf.getY(), leaf.getZ(), leaf.getSize() / 2);
  }
}

Extent extent_of(const octomap::OcTree& tree) {
  Extent out;
  for_each_occupied(tree, [&out](double x, double y, double z, double half) {
    const double at[3] = {x, y, z};
    for (int k = 0; k < 3; ++k) {
      out.low[k] = std::min(out.low[k], at[k] - half);
      out.high[k] = std::max(out.high[k], at[k] + half);
    }
  });
  return out;
}

std::string refusal_of(const Extent& extent, double cell_size, double level_height) {
  if (extent.low[0] > extent.high[0]) return "the map has no occupied voxel";
  if (extent.high[2] - extent.low[2] > kMaxLevels * level_height)
    return "the map is taller than 8000 voxels";
  if ((extent.high[0] - extent.low[0]) * (extent.high[1] - extent.low[1]) >
      kMaxCells * cell_size * cell_size)
    return "the map has more than 64 million cells of floor";
  return {};
}

void add_block(MapSurvey& survey, const Block& block, int tile) {
  for (int ty = floor_div(block.y0 - kBorder, tile); ty <= floor_div(block.y1 + kBorder, tile);
       ++ty) {
    for (int tx = floor_div(block.x0 - kBorder, tile); tx <= floor_div(block.x1 + kBorder, tile);
         ++tx) {
      const auto found = survey.fields.find({tx, ty});
      if (found == survey.fields.end()) continue;
      TileField& field = found->second;
      const Cell low{field.origin().x - kBorder, field.origin().y - kBorder};
      const int side = tile + 2 * kBorder;
      for (int y = std::max(block.y0, low.y); y < std::min(block.y1, low.y + side); ++y) {
        for (int x = std::max(block.x0, low.x); x < std::min(block.x1, low.x + side); ++x)
          field.add_span({x, y}, block.bottom, block.top);
      }
    }
  }
}

}  // namespace

MapSurvey survey_map(const octomap::OcTree& tree, double cell_size, double tile_size) {
  MapSurvey out;
  out.level_height = tree.getResolution();
  out.cell_size = cell_size > 0.0 ? cell_size : out.level_height;
  const Extent extent = extent_of(tree);
  out.error = refusal_of(extent, out.cell_size, out.level_height);
  if (!out.error.empty()) return out;

  const double cell = out.cell_size;
  const int tile = std::max(kMinTileCells, static_cast<int>(std::lround(tile_size / cell)));
  out.low = {floor_div(floor_cell(extent.low[0] / cell), tile) * tile,
             floor_div(floor_cell(extent.low[1] / cell), tile) * tile};
  out.high = {(floor_div(ceil_cell(extent.high[0] / cell) - 1, tile) + 1) * tile,
              (floor_div(ceil_cell(extent.high[1] / cell) - 1, tile) + 1) * tile};
  out.lowest_level = floor_cell(extent.low[2] / out.level_height);
  const int levels = ceil_cell(extent.high[2] / out.level_height) - out.lowest_level;
  for (int y = out.low.y; y < out.high.y; y += tile) {
    for (int x = out.low.x; x < out.high.x; x += tile)
      out.fields.emplace(TileIndex{x / tile, y / tile},
                         TileField({x, y}, tile, kBorder, levels, cell, out.level_height));
  }
  for_each_occupied(tree, [&](double x, double y, double z, double half) {
    add_block(
        out,
        {floor_cell((x - half) / cell), ceil_cell((x + half) / cell), floor_cell((y - half) / cell),
         ceil_cell((y + half) / cell), floor_cell((z - half) / out.level_height) - out.lowest_level,
         ceil_cell((z + half) / out.level_height) - out.lowest_level},
        tile);
  });
  return out;
}

int MapSurvey::floor_top(int headroom) const {
  std::map<int, int> tops;
  for (const auto& entry : fields) entry.second.count_tops(headroom, tops);
  int largest = 0;
  for (const auto& [top, cells] : tops) largest = std::max(largest, cells);
  for (const auto& [top, cells] : tops) {
    if (2 * cells >= largest) return top;
  }
  return 0;
}

std::vector<Ground> MapSurvey::settle(int floor_top, int headroom) {
  const int columns = high.x - low.x;
  const int rows = high.y - low.y;
  std::vector<Ground> ground(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (auto& entry : fields) {
    TileField& field = entry.second;
    const std::vector<Ground> own = field.settle(floor_top, headroom);
    const auto size = static_cast<std::ptrdiff_t>(field.size());
    for (int y = 0; y < field.size(); ++y) {
      const std::ptrdiff_t to =
          static_cast<std::ptrdiff_t>(field.origin().y - low.y + y) * columns +
          (field.origin().x - low.x);
      std::copy_n(own.begin() + y * size, size, ground.begin() + to);
    }
  }
  return ground;
}

}  // namespace navvi_nav
