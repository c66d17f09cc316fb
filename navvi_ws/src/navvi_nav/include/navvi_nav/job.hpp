#pragma once

#include <memory>
#include <optional>
#include <string>

#include "navvi_nav/planner.hpp"
#include "navvi_nav/replan_policy.hpp"

namespace navvi_nav {

/// A map as it came.
struct MapMessage {
  std::vector<std::int8_t> data;
  bool binary = true;
  std::string id;
  double resolution = 0.0;  ///< m
};

/// Work for whoever owns the Planner.
struct Job {
  std::shared_ptr<const MapMessage> map;      ///< null: keep the map
  std::shared_ptr<const OccupancyGrid> grid;  ///< likewise; not both
  std::vector<Cylinder> obstacles;
  std::vector<Cylinder> foreseen;  ///< to be avoided as well, if there is a way
  std::vector<Cylinder> ground;    ///< to be left free if there is no way to the goal; may be empty
  std::optional<Point> goal;       ///< nullopt: no plan is wanted
  Point start;
  Reason reason = Reason::none;
  unsigned goal_number = 0;
  bool show_mesh = false;  ///< a picture of the mesh is wanted, too
};

/// A finished job.
struct Outcome {
  Reason reason = Reason::none;
  unsigned goal_number = 0;
  std::optional<Plan> plan;
  MeshUpdate mesh;    ///< by the new map, if one came
  MeshUpdate carved;  ///< by the obstacles
  bool map_taken = false;
  std::string map_error;                ///< a sentence if a map came and was refused
  std::size_t polygons = 0;             ///< of the mesh, empty slots included
  std::shared_ptr<const Mesh> navmesh;  ///< if it was to be shown
  std::shared_ptr<const Floor> floor;
  double seconds = 0.0;  ///< wall clock, filled in by the caller of work()
};

/// Does one job. No exception leaves it.
[[nodiscard]] Outcome work(Planner& planner, const Job& job);

}  // namespace navvi_nav
