#include "plan/nav_mesh.hpp"

#include <utility>

namespace navvi_nav::plan {
namespace {

bool same_frame(const map::Floor& a, const map::Floor& b) {
  return a.cell_size() == b.cell_size() && a.origin().x == b.origin().x &&
         a.origin().y == b.origin().y && a.columns() == b.columns() && a.rows() == b.rows();
}

}  // namespace

void NavMeshConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(robot_radius, "robot_radius", Range{0.05, 2.0}, "m", "radius of the robot's hull");
  visit(robot_height, "robot_height", Range{0.1, 5.0}, "m",
        "of the robot with its load: a thing that hangs higher over the floor does not block");
  visit(cell_size, "cell_size", Range{0.0, 1.0}, "m",
        "edge of a cell of the mesh; 0: the map's voxel, or the part of it that erosion needs");
  visit(climb, "climb", Range{0.0, 0.5}, "m",
        "highest step that is driven over, and a voxel of more than 0.05 m at least (R-NAV-12); "
        "with it come ramps of less than 45 degrees (R-NAV-1); 0: none of them");
  visit(floor_height, "floor_height", Range{map::kAnyFloor, 1000.0}, "m",
        "z of the floor in map; -1000: the level on which the robot stands when the first OctoMap "
        "comes");
  visit(whole_cell_erosion, "whole_cell_erosion", navvi_config::Any{}, "",
        "round the eroded width up to whole cells (R-NAV-2)");
  visit(regions, "regions", navvi_config::OneOf{{"layers", "watershed"}}, "",
        "how Recast divides the floor before it is cut into polygons; layers take half the time");
  visit(contour_error, "contour_error", Range{0.0, 2.0}, "cells",
        "how deep a notch in a wall may be that is filled to draw the wall straight");
  visit(max_edge, "max_edge", Range{0.0, 100.0}, "m",
        "longer edges along walls are split; 0: never");
  visit(polygon_corners, "polygon_corners", Range{3.0, 12.0}, "", "most corners of a polygon");
  visit(carve_changed, "carve_changed", Range{0.0, 1.0}, "",
        "fraction of the carved area that must have changed before holes follow (R-NAV-5)");
  visit(zones, "zones", navvi_config::Any{}, "",
        "a YAML file of {name, kind: keep_out | slow | rack, corners, speed}: where the robot may "
        "not drive, or only slowly; empty: none");
}

double NavMesh::margin(double cell) const {
  return config_.whole_cell_erosion ? std::ceil(config_.robot_radius / cell) * cell
                                    : config_.robot_radius;
}

map::SurveyConfig survey_config(const NavMeshConfig& config, std::optional<double> stands_at) {
  return {config.cell_size, config.robot_height, config.climb, config.floor_height,
          config.threads,   config.robot_radius, stands_at};
}

bake::BakedMap NavMesh::bake(map::MapSurvey survey) const {
  bake::MapBakeConfig how;
  how.margin = margin(survey.cell_size);
  how.reach = clearance_ + 2.0 * survey.cell_size;
  how.tile_size = config_.tile_size;
  how.watershed = config_.regions == "watershed";
  how.contour_error = config_.contour_error;
  how.max_edge = config_.max_edge;
  how.max_corners = config_.polygon_corners;
  how.fine_parts = !config_.whole_cell_erosion;
  how.threads = config_.threads;
  if (survey.error.empty()) zones_.close(survey);
  return bake::bake_map(std::move(survey), how, &baked_);
}

MeshUpdate NavMesh::take(bake::BakedMap baked) {
  if (!baked.error.empty()) return {baked.error, 0, 0, 0};
  const std::shared_ptr<const map::Floor> before = std::exchange(floor_, baked.floor);
  baked_ = std::move(baked);
  const bool few = 2 * baked_.rebuilt.size() <= baked_.tiles.size();
  if (few && same_frame(*before, *floor_)) {
    change_tiles();
  } else {
    join_tiles();
  }
  return {{}, static_cast<int>(baked_.tiles.size()), static_cast<int>(baked_.rebuilt.size()), 0};
}

MeshUpdate NavMesh::carve(const std::vector<Cylinder>& cylinders) {
  MeshUpdate update;
  update.tiles = static_cast<int>(baked_.tiles.size());
  update.polygons_cut = carving_.carve(mesh_, cylinders);
  if (update.polygons_cut > 0) shown_.reset();
  return update;
}

std::shared_ptr<const mesh::Mesh> NavMesh::shared_mesh() const {
  if (!shown_) shown_ = std::make_shared<const mesh::Mesh>(mesh_.mesh());
  return shown_;
}

void NavMesh::join_tiles() {
  std::vector<mesh::GridPolygon> all;
  tile_polygons_.clear();
  for (const auto& [tile, polygons] : baked_.tiles) {
    std::vector<int>& numbers = tile_polygons_[tile];
    for (const mesh::GridPolygon& polygon : polygons) {
      numbers.push_back(static_cast<int>(all.size()));
      all.push_back(polygon);
    }
  }
  mesh_ = mesh::CutMesh(all, floor_->cell_size() / map::kStepsPerCellSide);
  carving_.repeat(mesh_);
  shown_.reset();
}

void NavMesh::change_tiles() {
  if (baked_.rebuilt.empty()) return;
  carving_.lift(mesh_);
  std::vector<int> gone;
  std::vector<mesh::GridPolygon> come;
  for (const bake::TileIndex& tile : baked_.rebuilt) {
    const std::vector<int>& numbers = tile_polygons_[tile];
    gone.insert(gone.end(), numbers.begin(), numbers.end());
    const auto polygons = baked_.tiles.find(tile);
    if (polygons != baked_.tiles.end())
      come.insert(come.end(), polygons->second.begin(), polygons->second.end());
  }
  const std::vector<int> numbers = mesh_.change_floor(gone, come);
  auto next = numbers.begin();
  for (const bake::TileIndex& tile : baked_.rebuilt) {
    const auto polygons = baked_.tiles.find(tile);
    const auto count = polygons == baked_.tiles.end() ? 0 : polygons->second.size();
    tile_polygons_[tile].assign(next, next + static_cast<std::ptrdiff_t>(count));
    next += static_cast<std::ptrdiff_t>(count);
  }
  carving_.repeat(mesh_);
  shown_.reset();
}

}  // namespace navvi_nav::plan
