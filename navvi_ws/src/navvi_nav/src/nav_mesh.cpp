#include "navvi_nav/nav_mesh.hpp"

#include <utility>

namespace navvi_nav {
namespace {

constexpr int kMaxHeadroom = 250;  // levels; Recast's compact spans have 8 bits for it

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

MeshUpdate NavMesh::set_map(const octomap::OcTree& tree) {
  MapSurvey survey = survey_map(tree, config_.cell_size, config_.tile_size);
  if (!survey.error.empty()) return {survey.error, 0, 0};
  const double cell = survey.cell_size;
  const int headroom =
      std::clamp(static_cast<int>(std::ceil(config_.robot_height / survey.level_height - 1e-6)), 1,
                 kMaxHeadroom);
  const int floor_top = survey.floor_top(headroom);
  const double keep = margin(cell);
  auto floor = std::make_shared<const Floor>(
      survey.low, survey.high.x - survey.low.x, survey.high.y - survey.low.y, cell,
      (survey.lowest_level + floor_top) * survey.level_height, survey.settle(floor_top, headroom),
      keep + config_.preferred_clearance + 2 * cell, keep);
  if (!floor->any_open()) return {"the map shows no walkable floor", 0, 0};
  const std::shared_ptr<const Floor> old = std::exchange(floor_, std::move(floor));

  MeshUpdate update;
  const bool comparable = !old->empty() && old->cell_size() == floor_->cell_size();
  std::map<TileIndex, Tile> tiles;
  for (auto& [index, field] : survey.fields) {
    Tile tile{std::move(field), {}};
    const auto before = tiles_.find(index);
    if (comparable && before != tiles_.end() && same_open_cells(tile.field, *old)) {
      tile.polygons = std::move(before->second.polygons);
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
  tile.polygons = tile.field.build(open, contours);
  if (clear(tile.polygons)) return;
  // Simplified contours can cross in places one cell wide; exact ones cannot.
  contours.max_error = 0.0;
  tile.polygons = tile.field.build(open, contours);
  if (clear(tile.polygons)) return;
  std::vector<GridPolygon> kept;
  for (const GridPolygon& polygon : tile.polygons) {
    if (clear({polygon})) kept.push_back(polygon);
  }
  tile.polygons = std::move(kept);
}

/// True if no point of the polygons is nearer than the robot's radius to anything that blocks.
bool NavMesh::clear(const std::vector<GridPolygon>& polygons) const {
  const Space around = space();
  const double cell = floor_->cell_size();
  for (const GridPolygon& grid : polygons) {
    std::vector<Point> c;
    Cell low{grid.corners[0][0], grid.corners[0][1]};
    Cell high = low;
    for (const auto& [x, y] : grid.corners) {
      c.push_back({x * cell, y * cell});
      low = {std::min(low.x, x), std::min(low.y, y)};
      high = {std::max(high.x, x), std::max(high.y, y)};
    }
    for (std::size_t k = 0; k < c.size(); ++k) {
      if (!around.segment_clear(c[k], c[(k + 1) % c.size()], config_.robot_radius)) return false;
    }
    for (const Cylinder& cylinder : carved_) {
      if (convex_contains(c, cylinder.center)) return false;
    }
    // With clear edges only something that lies wholly inside is left: some cell then blocks.
    for (int y = low.y; y < high.y; ++y) {
      for (int x = low.x; x < high.x; ++x) {
        if (floor_->ground({x, y}) != Ground::floor &&
            convex_contains(c, floor_->center_of({x, y})))
          return false;
      }
    }
  }
  return true;
}

void NavMesh::join_tiles() {
  std::vector<GridPolygon> all;
  for (const auto& entry : tiles_)
    all.insert(all.end(), entry.second.polygons.begin(), entry.second.polygons.end());
  mesh_ = std::make_shared<Mesh>(join(all, floor_->cell_size()));
}

}  // namespace navvi_nav
