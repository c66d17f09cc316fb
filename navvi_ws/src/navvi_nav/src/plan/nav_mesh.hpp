#pragma once

#include <map>
#include <memory>
#include <navvi_config/field.hpp>
#include <navvi_floor/floor.hpp>
#include <navvi_floor/map_survey.hpp>
#include <navvi_floor/occupancy_grid.hpp>
#include <navvi_floor/zones.hpp>
#include <navvi_types/motion.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bake/map_bake.hpp"
#include "mesh/cut_mesh.hpp"
#include "mesh/mesh.hpp"
#include "plan/carving.hpp"
#include "smooth/guide_cost.hpp"

namespace navvi_nav::plan {

struct NavMeshConfig {
  double robot_radius = 0.35;
  double robot_height = navvi_types::kHeadroom;
  double cell_size = 0.0;
  double climb = 0.04;
  double floor_height = map::kAnyFloor;
  bool whole_cell_erosion = false;
  std::string regions = "layers";
  double contour_error = 1.0;
  double tile_size = 32.0;  ///< m, edge of a tile
  double max_edge = 0.0;
  int polygon_corners = 12;
  int threads = 2;  ///< that share the work on a new map
  double carve_changed = 0.0;
  std::string zones;  ///< their file; empty: none

  void describe(navvi_config::Visitor& visit);
};

/// How a map is surveyed for this mesh. \param stands_at  as SurveyConfig's
[[nodiscard]] map::SurveyConfig survey_config(const NavMeshConfig& config,
                                              std::optional<double> stands_at = std::nullopt);

/// What one change of the mesh did.
struct MeshUpdate {
  std::string error;      ///< a sentence if the map was refused; the mesh is then unchanged
  int tiles = 0;          ///< in the map
  int tiles_rebuilt = 0;  ///< by this change
  int polygons_cut = 0;   ///< polygons of the floor that were cut anew because holes changed
};

/// The floor that an OctoMap shows, as tiles of convex polygons (R-NAV-1..5). Clear by
/// construction: no point of the mesh is nearer than the robot's radius to an occupied voxel that
/// rises above the floor (or hangs lower than the robot's height), to the edge of the floor, or to
/// a carved cylinder. survey_map() defines the floor.
class NavMesh {
 public:
  /// \param clearance  m, beyond the robot's radius, that is known of each place on the floor
  explicit NavMesh(const NavMeshConfig& config,
                   double clearance = smooth::GuideCostConfig{}.preferred_clearance)
      : config_(config),
        clearance_(clearance),
        zones_(config.zones),
        carving_({config.robot_radius, config.carve_changed}) {}

  /// Takes a new map, or refuses it in a sentence and keeps the last one. Tiles in which nothing
  /// changed keep their polygons.
  /// \param map  anything that bake() takes
  template <typename Map>
  MeshUpdate set_map(Map&& map) {
    return take(bake(std::forward<Map>(map)));
  }
  /// The first part of set_map(), nearly all of its time. Another thread may do it while this one
  /// carves and plans; only one at a time, and take() must follow before the next.
  [[nodiscard]] bake::BakedMap bake(map::MapSurvey survey) const;
  /// \param stands_at  m, z of base_link, by which the floor is told from other levels
  [[nodiscard]] bake::BakedMap bake(const map::MapBytes& bytes,
                                    std::optional<double> stands_at = std::nullopt) const {
    return bake(map::survey_map(bytes, survey_config(config_, stands_at), baked_.record.get(),
                                baked_.floor.get()));
  }
  [[nodiscard]] bake::BakedMap bake(const map::Voxels& voxels,
                                    std::optional<double> stands_at = std::nullopt) const {
    return bake(map::survey_map(voxels, survey_config(config_, stands_at)));
  }
  [[nodiscard]] bake::BakedMap bake(const map::OccupancyGrid& grid) const {
    return bake(map::read_grid(grid, survey_config(config_)));
  }
  /// The rest of it.
  MeshUpdate take(bake::BakedMap baked);
  /// Makes the holes those of `cylinders`: the hole of one whose id is gone heals. Nothing happens
  /// while less than the fraction `carve_changed` of the carved area changed (R-NAV-5).
  MeshUpdate carve(const std::vector<Cylinder>& cylinders);

  [[nodiscard]] bool empty() const { return !floor_ || floor_->empty(); }
  [[nodiscard]] const mesh::Mesh& mesh() const { return mesh_.mesh(); }
  /// These two never change once handed out, so another thread may keep them. The mesh is copied
  /// when it is asked for, once after each change.
  [[nodiscard]] std::shared_ptr<const mesh::Mesh> shared_mesh() const;
  [[nodiscard]] std::shared_ptr<const map::Floor> shared_floor() const { return floor_; }
  /// As CutMesh::floor_components.
  [[nodiscard]] std::set<int> floor_components(Point point, double reach) const {
    return mesh_.floor_components(point, reach);
  }
  /// As CutMesh::nearest_on_floor.
  [[nodiscard]] std::optional<Point> nearest_on_floor(Point point,
                                                      const std::set<int>& components) const {
    return mesh_.nearest_on_floor(point, components);
  }
  /// The cylinders as carved.
  [[nodiscard]] const std::vector<Cylinder>& carved() const { return carving_.carved(); }
  [[nodiscard]] map::Space space() const { return {floor_.get(), &carved()}; }
  [[nodiscard]] const NavMeshConfig& config() const { return config_; }
  [[nodiscard]] double clearance() const { return clearance_; }  ///< as constructed
  [[nodiscard]] const map::Zones& zones() const { return zones_; }

 private:
  [[nodiscard]] double margin(double cell) const;
  void join_tiles();
  void change_tiles();

  NavMeshConfig config_;
  double clearance_;
  map::Zones zones_;
  bake::BakedMap baked_;
  std::shared_ptr<const map::Floor> floor_ = std::make_shared<map::Floor>();
  std::map<bake::TileIndex, std::vector<int>> tile_polygons_;  // numbers in the mesh's floor
  mesh::CutMesh mesh_;
  Carving carving_;
  mutable std::shared_ptr<const mesh::Mesh> shown_;  // a copy of the mesh as it is; null: none yet
};

}  // namespace navvi_nav::plan
