#include "navvi_nav/nav_mesh.hpp"

#include <utility>

namespace navvi_nav {
namespace {

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

void NavMeshConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"robot_radius", Range{0.05, 2.0}, "m", "radius of the robot's hull"}, robot_radius);
  visit({"robot_height", Range{0.1, 5.0}, "m", "what hangs higher over the floor does not block"},
        robot_height);
  visit({"cell_size", Range{0.0, 1.0}, "m", "edge of a cell of the mesh; 0: the map's voxel"},
        cell_size);
  visit({"climb", Range{0.0, 0.5}, "m",
         "highest step that is driven over; steps below 0.05 m are no obstacles (R-NAV-12)"},
        climb);
  visit({"floor_height", Range{kAnyFloor, 1000.0}, "m",
         "z of the floor in map; -1000: the lowest that is at least half as large as the largest"},
        floor_height);
  visit({"whole_cell_erosion", navvi_config::Any{}, "",
         "round the eroded width up to whole cells (R-NAV-2)"},
        whole_cell_erosion);
  visit({"contour_error", Range{0.0, 2.0}, "cells",
         "how deep a notch in a wall may be that is filled to draw the wall straight"},
        contour_error);
  visit({"tile_size", Range{2.0, 64.0}, "m", "edge of a tile"}, tile_size);
  visit({"max_edge", Range{0.0, 100.0}, "m", "longer edges along walls are split; 0: never"},
        max_edge);
  visit({"polygon_corners", Range{3.0, 12.0}, "", "most corners of a polygon"}, polygon_corners);
  visit({"threads", Range{1.0, 64.0}, "", "that share the work on a new map"}, threads);
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
  return config_.whole_cell_erosion ? std::ceil(config_.robot_radius / cell) * cell
                                    : config_.robot_radius;
}

SurveyConfig survey_config(const NavMeshConfig& config) {
  return {config.cell_size, config.robot_height, config.climb, config.floor_height};
}

MeshUpdate NavMesh::set_map(MapSurvey survey) {
  MapBakeConfig how;
  how.margin = margin(survey.cell_size);
  how.reach = config_.preferred_clearance + 2.0 * survey.cell_size;
  how.tile_size = config_.tile_size;
  how.contour_error = config_.contour_error;
  how.max_edge = config_.max_edge;
  how.max_corners = config_.polygon_corners;
  how.threads = config_.threads;
  BakedMap baked = bake_map(std::move(survey), how, &baked_);
  if (!baked.error.empty()) return {baked.error, 0, 0};
  baked_ = std::move(baked);
  floor_ = baked_.floor;
  tiles_ = baked_.tiles;
  for (const auto& entry : baked_.tiles) carve_tile(entry.first);
  join_tiles();
  return {{}, static_cast<int>(tiles_.size()), static_cast<int>(baked_.rebuilt.size())};
}

bool NavMesh::touches(TileIndex tile, const Cylinder& cylinder) const {
  const double cell = floor_->cell_size();
  const double side = baked_.tile_cells * cell;
  const double reach = cylinder.radius + margin(cell) + 2 * cell;
  const double x0 = tile.first * side;
  const double y0 = tile.second * side;
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
  for (const auto& entry : baked_.tiles) {
    const bool hit = std::any_of(touched.begin(), touched.end(), [&](const Cylinder& cylinder) {
      return touches(entry.first, cylinder);
    });
    if (!hit) continue;
    tiles_[entry.first] = entry.second;
    carve_tile(entry.first);
    ++update.tiles_rebuilt;
  }
  if (update.tiles_rebuilt > 0) join_tiles();
  return update;
}

void NavMesh::carve_tile(TileIndex tile) {
  TileCells cells = cells_of(*floor_, tile, baked_.tile_cells);
  const double cell = floor_->cell_size();
  const double grow = floor_->grow() * cell / kStepsPerCellSide;
  const double keep = margin(cell);
  bool any = false;
  for (const Cylinder& cylinder : carved_) {
    if (!touches(tile, cylinder)) continue;
    any = true;
    for (int y = -1; y <= cells.size; ++y) {
      for (int x = -1; x <= cells.size; ++x) {
        const Point low{(cells.origin.x + x) * cell - grow, (cells.origin.y + y) * cell - grow};
        const Point high{low.x + cell + 2 * grow, low.y + cell + 2 * grow};
        const double dx = std::max({low.x - cylinder.center.x, 0.0, cylinder.center.x - high.x});
        const double dy = std::max({low.y - cylinder.center.y, 0.0, cylinder.center.y - high.y});
        if (std::hypot(dx, dy) < cylinder.radius + keep)
          cells.open[static_cast<std::size_t>((y + 1) * (cells.size + 2) + x + 1)] = 0;
      }
    }
  }
  if (!any) return;
  BakeConfig how;
  how.contour_error = config_.contour_error;
  how.max_edge = static_cast<int>(config_.max_edge / cell);
  how.max_corners = config_.polygon_corners;
  how.merge_region = static_cast<int>(1.0 / (cell * cell));
  how.grow = floor_->grow();
  tiles_[tile] = bake_tile(cells, how);
}

void NavMesh::join_tiles() {
  std::vector<GridPolygon> all;
  for (const auto& entry : tiles_) all.insert(all.end(), entry.second.begin(), entry.second.end());
  mesh_ = std::make_shared<Mesh>(join(all, floor_->cell_size() / kStepsPerCellSide));
}

}  // namespace navvi_nav
