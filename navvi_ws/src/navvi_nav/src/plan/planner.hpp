#pragma once

#include <navvi_files/cache.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plan/guide_path.hpp"
#include "plan/nav_mesh.hpp"
#include "plan/plan_request.hpp"
#include "plan/route.hpp"
#include "search/search.hpp"
#include "smooth/smoothing.hpp"

namespace navvi_nav::plan {

/// The shortest route of a robot at `start` to a place outside of `swept_area`, with some room to
/// it where there is; without a path if there is no such place within 12 m.
[[nodiscard]] Route find_retreat(RouteFinder& routes, const std::vector<Cylinder>& swept_area,
                                 Point start);

struct PlannerConfig {
  NavMeshConfig mesh;
  smooth::SmoothingConfig smoothing;
  std::string search = "exact";
  double alpha = 1.0;
  static constexpr double kStartSnap = 0.5;  ///< m, how far off the mesh the robot may stand

  void describe(navvi_config::Visitor& visit);
};

/// From a map and obstacles to a path: the package in one function, answer().
class Planner {
 public:
  /// \param cache  of first maps; nullptr: none is kept
  explicit Planner(const PlannerConfig& config, const navvi_files::Cache* cache = nullptr);

  /// Takes the map, carves the obstacles, searches a path and smooths it. A path that only
  /// obstacles close is returned as closed, or as a retreat if the request names a swept area and
  /// there is room outside of it. Obstacles of a request without a goal, that shows nothing either,
  /// are carved when a later one needs the mesh, unless small changes are let pass
  /// (`carve_changed`). No exception leaves it.
  [[nodiscard]] PlanAnswer answer(const PlanRequest& request) {
    return answer(request, bake(request));
  }
  /// Likewise. \param baked  what bake() made of the request
  [[nodiscard]] PlanAnswer answer(const PlanRequest& request, bake::BakedMap baked);
  /// Nearly all the work on a request's map, if it brings one: as NavMesh::bake, it may be done
  /// while another thread has other requests answered. No exception leaves it.
  [[nodiscard]] bake::BakedMap bake(const PlanRequest& request) const;

  /// \param map  anything that NavMesh::set_map takes
  template <typename Map>
  MeshUpdate set_map(const Map& map) {
    return nav_mesh_.set_map(map);
  }
  MeshUpdate carve(const std::vector<Cylinder>& cylinders) {
    uncarved_.reset();
    return nav_mesh_.carve(cylinders);
  }
  /// A path for the robot at `start` to exactly `goal`, clear of the latest obstacles. Nothing is
  /// moved in silence: only a start off the mesh is taken to the nearest point of it, at most
  /// `start_snap` away, and from within an obstacle's hole the path begins with a straight leg out
  /// of it: see escape().
  /// \param followed  a path to the goal whose corners are known: as many as lead there are kept,
  /// unless that costs more than smoothing.keep
  /// \param toward  to a goal that is not seen yet as RouteFinder::find_toward(): it ends short
  [[nodiscard]] Plan plan(Point start, Point goal, const Path& followed = {}, bool toward = false);
  /// As find_retreat(), or no_route.
  [[nodiscard]] Plan retreat(const std::vector<Cylinder>& swept_area, Point start);
  [[nodiscard]] const NavMesh& nav_mesh() const { return nav_mesh_; }

 private:
  void carve_latest();
  [[nodiscard]] Plan best_plan(const PlanRequest& request);
  [[nodiscard]] Plan plan(const PlanRequest& request) {
    return plan(request.start, *request.goal, request.followed, request.toward);
  }
  [[nodiscard]] Plan clear_plan(const PlanRequest& request);
  [[nodiscard]] Plan plan_without_obstacles(const PlanRequest& request, const Plan& blocked);
  [[nodiscard]] RouteFinder routes() { return {nav_mesh_, search_, config_.kStartSnap}; }

  PlannerConfig config_;
  const navvi_files::Cache* cache_;
  NavMesh nav_mesh_;
  std::optional<std::vector<Cylinder>> uncarved_;  ///< the latest, until something needs the mesh
  search::Search search_;
  GuidePaths guide_paths_;
};

}  // namespace navvi_nav::plan
