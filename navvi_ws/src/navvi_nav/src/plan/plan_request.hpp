#pragma once

#include <memory>
#include <navvi_types/guidance.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plan/nav_mesh.hpp"

namespace navvi_nav::plan {

using navvi_types::Guidance;

/// An OctoMap as received.
struct MapMessage {
  std::vector<std::int8_t> data;
  bool binary = true;
  std::string id;
  double resolution = 0.0;  ///< m
  std::optional<map::Voxels> voxels = {};  ///< in place of all this, by one that knows them
};

/// One query to the Planner.
struct PlanRequest {
  std::shared_ptr<const MapMessage> map;           ///< null: keep the map
  std::shared_ptr<const map::OccupancyGrid> grid;  ///< likewise; not both
  std::optional<double> stands_at;                 ///< m, z of base_link, for the map's survey
  std::vector<Cylinder> obstacles;
  std::vector<Cylinder> predicted;   ///< where obstacles will be: avoided if there is a path
  std::vector<Cylinder> swept_area;  ///< to leave free if obstacles close the path; may be empty
  std::optional<Point> goal;         ///< nullopt: only map and obstacles are taken
  Point start;
  Path followed;        ///< the rest of the path to the goal so far, from the robot; may be empty
  bool toward = false;  ///< a path to where the map ends will do for a goal beyond it
  bool show_mesh = false;  ///< return a copy of the mesh, too

  [[nodiscard]] bool brings_map() const { return map || grid; }
};

enum class PlanStatus {
  found,
  no_map,
  off_mesh,
  refused,
  no_route,
  closed,   ///< only obstacles close the path, which is the one without them
  retreat,  ///< likewise, and the path leads out of the swept area
};

struct Plan {
  PlanStatus status = PlanStatus::no_map;
  Guidance::Refusal refusal = Guidance::Refusal::none;
  Path path;  ///< from the robot (or the mesh next to it) to the goal
  /// The goal is not seen yet, as `refusal` and `detail` tell, and the path ends at the place that
  /// is nearest to it.
  bool ends_short = false;
  double shortest = 0.0;  ///< m, of the path before smoothing
  std::size_t nodes_expanded = 0;
  std::string detail;  ///< a sentence
};

/// A plan without a path. \param detail  why, a sentence
[[nodiscard]] inline Plan no_plan(PlanStatus status, std::string detail,
                                  Guidance::Refusal refusal = Guidance::Refusal::none) {
  Plan out;
  out.status = status;
  out.refusal = refusal;
  out.detail = std::move(detail);
  return out;
}

struct PlanAnswer {
  std::optional<Plan> plan;  ///< nullopt: none was requested
  MeshUpdate mesh;           ///< by the new map, if one came
  bool map_taken = false;
  std::string map_error;                      ///< a sentence if a map came and was refused
  std::shared_ptr<const mesh::Mesh> navmesh;  ///< null unless it was requested
  std::size_t polygons = 0;                   ///< of the mesh, empty slots included
  std::shared_ptr<const map::Floor> floor;
  double seconds = 0.0;  ///< wall clock, filled in by the caller
};

}  // namespace navvi_nav::plan
