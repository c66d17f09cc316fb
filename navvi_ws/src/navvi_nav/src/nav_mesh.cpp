#include "navvi_nav/nav_mesh.hpp"

#include <limits>

namespace navvi_nav {
namespace {

constexpr int kBorder = 4;            // cells looked at around a tile, so that neighbours agree
constexpr int kMaxLevels = 8000;      // Recast's spans have 13 bits
constexpr double kMaxCells = 64.0e6;  // of the whole map
constexpr double kRounding = 1e-4;    // cells

int floor_cell(double value) { return static_cast<int>(std::floor(value + kRounding)); }
int ceil_cell(double value) { return static_cast<int>(std::ceil(value - kRounding)); }
int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

const Cylinder* find(const std::vector<Cylinder>& cylinders, std::uint32_t id) {
  for (const Cylinder& cylinder : cylinders) {
    if (cylinder.id == id) return &cylinder;
  }
  return nullptr;
}

double area(double radius) { return M_PI * radius * radius; }

/// m^2, of the part that two circles share
double shared_area(double d, double r, double s) {
  if (d >= r + s) return 0.0;
  if (d <= std::abs(r - s)) return area(std::min(r, s));
  const double a = std::acos(std::clamp((d * d + r * r - s * s) / (2 * d * r), -1.0, 1.0));
  const double b = std::acos(std::clamp((d * d + s * s - r * r) / (2 * d * s), -1.0, 1.0));
  return r * r * (a - std::sin(2 * a) / 2) + s * s * (b - std::sin(2 * b) / 2);
}

bool same_hole(const Cylinder& a, const Cylinder& b) {
  return a.center == b.center && a.radius == b.radius;
}

}  // namespace

/// Everything of a new map before it replaces the old one.
struct NavMesh::Survey {
  std::string error;
  double cell_size = 0.0;
  double level_height = 0.0;
  int lowest_level = 0;
  int levels = 0;
  Cell low;   // of the tiles
  Cell high;  // one beyond
  int tile_cells = 0;
  std::map<TileIndex, TileField> fields;
};

void NavMeshConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"robot_radius", Range{0.05, 2.0}, "m", "radius of the robot's hull"}, robot_radius);
  visit({"robot_height", Range{0.1, 5.0}, "m", "what hangs higher over the floor does not block"},
        robot_height);
  visit({"cell_size", Range{0.0, 1.0}, "m", "edge of a cell of the mesh; 0: the map's voxel"},
        cell_size);
  visit({"whole_cell_erosion", navvi_config::Any{}, "",
         "round the eroded width up to whole cells (R-NAV-2)"},
        whole_cell_erosion);
  visit({"contour_error", Range{0.0, 2.0}, "cells",
         "how far contours are simplified; the mesh is eroded by as much more"},
        contour_error);
  visit({"tile_size", Range{2.0, 64.0}, "m", "edge of a tile"}, tile_size);
  visit({"max_edge", Range{0.0, 100.0}, "m", "longer edges along walls are split; 0: never"},
        max_edge);
  visit({"preferred_clearance", Range{0.0, 2.0}, "m",
         "room a guide path leaves beyond the robot's radius where there is room"},
        preferred_clearance);
  visit({"carve_moved", Range{0.0, 1.0}, "m", "an obstacle that moved less keeps its hole"},
        carve_moved);
  visit({"carve_changed", Range{0.0, 1.0}, "",
         "fraction of the carved area that must have changed before tiles are rebuilt"},
        carve_changed);
}

double NavMesh::margin(double cell) const {
  const double eroded = config_.whole_cell_erosion ? std::ceil(config_.robot_radius / cell) * cell
                                                   : config_.robot_radius;
  return eroded + config_.contour_error * cell;
}

NavMesh::Survey NavMesh::survey(const octomap::OcTree& tree) const {
  Survey out;
  out.level_height = tree.getResolution();
  out.cell_size = config_.cell_size > 0.0 ? config_.cell_size : tree.getResolution();
  double low[3] = {1e9, 1e9, 1e9};
  double high[3] = {-1e9, -1e9, -1e9};
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const double half = leaf.getSize() / 2;
    const double at[3] = {leaf.getX(), leaf.getY(), leaf.getZ()};
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], at[k] - half);
      high[k] = std::max(high[k], at[k] + half);
    }
  }
  if (low[0] > high[0]) {
    out.error = "the map has no occupied voxel";
    return out;
  }
  out.lowest_level = floor_cell(low[2] / out.level_height);
  out.levels = ceil_cell(high[2] / out.level_height) - out.lowest_level;
  if (out.levels > kMaxLevels) {
    out.error = "the map is taller than 8000 voxels";
    return out;
  }
  if ((high[0] - low[0]) * (high[1] - low[1]) > kMaxCells * out.cell_size * out.cell_size) {
    out.error = "the map has more than 64 million cells of floor";
    return out;
  }
  out.tile_cells = std::max(16, static_cast<int>(std::lround(config_.tile_size / out.cell_size)));
  const int size = out.tile_cells;
  out.low = {floor_div(floor_cell(low[0] / out.cell_size), size) * size,
             floor_div(floor_cell(low[1] / out.cell_size), size) * size};
  out.high = {(floor_div(ceil_cell(high[0] / out.cell_size) - 1, size) + 1) * size,
              (floor_div(ceil_cell(high[1] / out.cell_size) - 1, size) + 1) * size};
  for (int y = out.low.y; y < out.high.y; y += size) {
    for (int x = out.low.x; x < out.high.x; x += size)
      out.fields.emplace(TileIndex{x / size, y / size}, TileField({x, y}, size, kBorder, out.levels,
                                                                  out.cell_size, out.level_height));
  }
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const double half = leaf.getSize() / 2;
    const int x0 = floor_cell((leaf.getX() - half) / out.cell_size);
    const int x1 = ceil_cell((leaf.getX() + half) / out.cell_size);
    const int y0 = floor_cell((leaf.getY() - half) / out.cell_size);
    const int y1 = ceil_cell((leaf.getY() + half) / out.cell_size);
    const int bottom = floor_cell((leaf.getZ() - half) / out.level_height) - out.lowest_level;
    const int top = ceil_cell((leaf.getZ() + half) / out.level_height) - out.lowest_level;
    for (int ty = floor_div(y0 - kBorder, size); ty <= floor_div(y1 + kBorder, size); ++ty) {
      for (int tx = floor_div(x0 - kBorder, size); tx <= floor_div(x1 + kBorder, size); ++tx) {
        const auto found = out.fields.find({tx, ty});
        if (found == out.fields.end()) continue;
        TileField& field = found->second;
        const int from_x = std::max(x0, field.origin().x - kBorder);
        const int to_x = std::min(x1, field.origin().x + size + kBorder);
        const int from_y = std::max(y0, field.origin().y - kBorder);
        const int to_y = std::min(y1, field.origin().y + size + kBorder);
        for (int y = from_y; y < to_y; ++y) {
          for (int x = from_x; x < to_x; ++x) field.add_span({x, y}, bottom, top);
        }
      }
    }
  }
  return out;
}

MeshUpdate NavMesh::set_map(const octomap::OcTree& tree) {
  Survey next = survey(tree);
  if (!next.error.empty()) return {next.error, 0, 0};
  const int headroom = std::clamp(ceil_cell(config_.robot_height / next.level_height), 1, 250);
  std::map<int, int> tops;
  for (const auto& entry : next.fields) entry.second.count_tops(headroom, tops);
  int largest = 0;
  for (const auto& [top, cells] : tops) largest = std::max(largest, cells);
  int floor_top = 0;
  for (const auto& [top, cells] : tops) {
    if (2 * cells < largest) continue;
    floor_top = top;
    break;
  }

  const int columns = next.high.x - next.low.x;
  const int rows = next.high.y - next.low.y;
  std::vector<Ground> ground(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (auto& entry : next.fields) {
    TileField& field = entry.second;
    const std::vector<Ground> own = field.settle(floor_top, headroom);
    const auto size = static_cast<std::ptrdiff_t>(field.size());
    for (int y = 0; y < field.size(); ++y) {
      const std::ptrdiff_t to =
          static_cast<std::ptrdiff_t>(field.origin().y - next.low.y + y) * columns +
          (field.origin().x - next.low.x);
      std::copy_n(own.begin() + y * size, size, ground.begin() + to);
    }
  }

  const double keep = margin(next.cell_size);
  auto floor = std::make_shared<const Floor>(
      next.low, columns, rows, next.cell_size, (next.lowest_level + floor_top) * next.level_height,
      std::move(ground), keep + config_.preferred_clearance + 2 * next.cell_size, keep);
  if (!floor->any_open()) return {"the map shows no walkable floor", 0, 0};
  const std::shared_ptr<const Floor> old = std::exchange(floor_, std::move(floor));

  MeshUpdate update;
  const bool comparable = !old->empty() && old->cell_size() == floor_->cell_size();
  std::map<TileIndex, Tile> tiles;
  for (auto& [index, field] : next.fields) {
    Tile tile{std::move(field), {}};
    const auto before = tiles_.find(index);
    if (comparable && before != tiles_.end() && same_open_cells(tile.field, *old)) {
      tile.triangles = std::move(before->second.triangles);
    } else {
      build(tile);
      ++update.tiles_rebuilt;
    }
    tiles.emplace(index, std::move(tile));
  }
  tiles_ = std::move(tiles);
  update.tiles = static_cast<int>(tiles_.size());
  join_tiles();
  return update;
}

bool NavMesh::same_open_cells(const TileField& field, const Floor& old) const {
  const Cell low{field.origin().x - field.border(), field.origin().y - field.border()};
  const int side = field.size() + 2 * field.border();
  for (int y = low.y; y < low.y + side; ++y) {
    for (int x = low.x; x < low.x + side; ++x) {
      if (old.open({x, y}) != floor_->open({x, y})) return false;
    }
  }
  return true;
}

bool NavMesh::touches(const TileField& field, const Cylinder& cylinder) const {
  const double cell = floor_->cell_size();
  const double reach = cylinder.radius + margin(cell) + (field.border() + 2) * cell;
  const double x0 = field.origin().x * cell;
  const double y0 = field.origin().y * cell;
  const double side = field.size() * cell;
  const double dx = std::max({x0 - cylinder.center.x, 0.0, cylinder.center.x - x0 - side});
  const double dy = std::max({y0 - cylinder.center.y, 0.0, cylinder.center.y - y0 - side});
  return dx * dx + dy * dy <= reach * reach;
}

bool NavMesh::changed_enough(const std::vector<Cylinder>& next) const {
  if (config_.carve_changed <= 0.0) return true;
  double total = 0.0;
  double kept = 0.0;
  for (const Cylinder& cylinder : carved_) total += area(cylinder.radius);
  double changed = total;
  for (const Cylinder& cylinder : next) {
    changed += area(cylinder.radius);
    if (const Cylinder* before = find(carved_, cylinder.id))
      kept +=
          shared_area(distance(before->center, cylinder.center), before->radius, cylinder.radius);
  }
  changed -= 2.0 * kept;
  return total <= 0.0 ? changed > 0.0 : changed > config_.carve_changed * total;
}

MeshUpdate NavMesh::carve(const std::vector<Cylinder>& cylinders) {
  MeshUpdate update;
  update.tiles = static_cast<int>(tiles_.size());
  std::vector<Cylinder> next = cylinders;
  for (Cylinder& cylinder : next) {
    const Cylinder* before = find(carved_, cylinder.id);
    if (before && before->radius == cylinder.radius &&
        distance(before->center, cylinder.center) < config_.carve_moved)
      cylinder.center = before->center;
  }
  std::vector<Cylinder> touched;
  for (const Cylinder& cylinder : next) {
    const Cylinder* before = find(carved_, cylinder.id);
    if (before && same_hole(*before, cylinder)) continue;
    touched.push_back(cylinder);
    if (before) touched.push_back(*before);
  }
  for (const Cylinder& before : carved_) {
    if (!find(next, before.id)) touched.push_back(before);
  }
  if (touched.empty() || !changed_enough(next)) return update;
  carved_ = std::move(next);
  for (auto& entry : tiles_) {
    Tile& tile = entry.second;
    const bool hit = std::any_of(touched.begin(), touched.end(), [&](const Cylinder& cylinder) {
      return touches(tile.field, cylinder);
    });
    if (!hit) continue;
    build(tile);
    ++update.tiles_rebuilt;
  }
  if (update.tiles_rebuilt > 0) join_tiles();
  return update;
}

void NavMesh::build(Tile& tile) {
  std::vector<Cylinder> near;
  for (const Cylinder& cylinder : carved_) {
    if (touches(tile.field, cylinder)) near.push_back(cylinder);
  }
  const double cell = floor_->cell_size();
  const double keep = margin(cell);
  const auto open = [&](Cell at) {
    if (!floor_->open(at)) return false;
    const Point low{at.x * cell, at.y * cell};
    return std::none_of(near.begin(), near.end(), [&](const Cylinder& cylinder) {
      const double dx =
          std::max({low.x - cylinder.center.x, 0.0, cylinder.center.x - low.x - cell});
      const double dy =
          std::max({low.y - cylinder.center.y, 0.0, cylinder.center.y - low.y - cell});
      return std::hypot(dx, dy) < cylinder.radius + keep;
    });
  };
  TileField::Contours contours;
  contours.max_error = config_.contour_error;
  contours.max_edge = static_cast<int>(config_.max_edge / cell);
  contours.merge_region = static_cast<int>(1.0 / (cell * cell));
  tile.triangles = tile.field.build(open, contours);
  if (clear(tile.triangles)) return;
  // Simplified contours can cross in places one cell wide; exact ones cannot.
  contours.max_error = 0.0;
  tile.triangles = tile.field.build(open, contours);
  if (clear(tile.triangles)) return;
  std::vector<GridTriangle> kept;
  for (const GridTriangle& triangle : tile.triangles) {
    if (clear({triangle})) kept.push_back(triangle);
  }
  tile.triangles = std::move(kept);
}

/// True if no point of the triangles is nearer than the robot's radius to anything that blocks.
bool NavMesh::clear(const std::vector<GridTriangle>& triangles) const {
  const Space around = space();
  const double cell = floor_->cell_size();
  for (const GridTriangle& grid : triangles) {
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k)
      triangle.corners[k] = {grid.corners[k][0] * cell, grid.corners[k][1] * cell};
    const auto& c = triangle.corners;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!around.segment_clear(c[k], c[(k + 1) % 3], config_.robot_radius)) return false;
    }
    for (const Cylinder& cylinder : carved_) {
      if (triangle.contains(cylinder.center)) return false;
    }
    // With clear edges only something that lies wholly inside is left: some cell then blocks.
    const auto [x0, x1] = std::minmax({grid.corners[0][0], grid.corners[1][0], grid.corners[2][0]});
    const auto [y0, y1] = std::minmax({grid.corners[0][1], grid.corners[1][1], grid.corners[2][1]});
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        if (floor_->ground({x, y}) != Ground::floor && triangle.contains(floor_->center_of({x, y})))
          return false;
      }
    }
  }
  return true;
}

void NavMesh::join_tiles() {
  std::vector<GridTriangle> all;
  for (const auto& entry : tiles_)
    all.insert(all.end(), entry.second.triangles.begin(), entry.second.triangles.end());
  mesh_ = std::make_shared<Mesh>(join(all, floor_->cell_size()));
}

}  // namespace navvi_nav
