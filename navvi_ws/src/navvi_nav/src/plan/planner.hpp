#pragma once

#include <optional>
#include <set>
#include <string>

#include "plan/nav_mesh.hpp"
#include "plan/plan_request.hpp"
#include "search/search.hpp"
#include "smooth/smoothing.hpp"

namespace navvi_nav::plan {

struct PlannerConfig {
  NavMeshConfig mesh;
  smooth::SmoothingConfig smoothing;
  std::string search = "exact";
  double alpha = 1.0;
  double start_snap = 0.5;

  void describe(navvi_config::Visitor& visit);
};

/// From a map and obstacles to a path: the package in one function, answer().
class Planner {
 public:
  explicit Planner(const PlannerConfig& config);

  /// Takes the map, carves the obstacles, searches a path and smooths it. A path that only
  /// obstacles close is returned as closed, or as a retreat if the request names a swept area and
  /// there is room outside of it. Obstacles of a request without a goal, that shows nothing either,
  /// are carved when a later one needs the mesh, unless small moves are let pass (`carve_moved`,
  /// `carve_changed`). No exception leaves it.
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
  /// A path for the robot at `start` to exactly `goal`, on the mesh as it was carved last. Nothing is moved in silence: only a start
  /// off the mesh is taken to the nearest point of it, at most `start_snap` away, and from within
  /// an obstacle's hole the path begins with a straight leg out of it: see escape().
  /// \param followed  a path to the goal whose corners are known: as many as lead there are kept,
  /// unless that costs more than smoothing.keep
  [[nodiscard]] Plan plan(Point start, Point goal, const Path& followed = {}) const {
    return guided(search(start, goal), followed);
  }
  /// The shortest path to a place outside of `swept_area`, with some room to it where there is, or
  /// no_route.
  [[nodiscard]] Plan retreat(const std::vector<Cylinder>& swept_area, Point start) const {
    return guided(search_retreat(swept_area, start), {});
  }
  /// As plan(), but if nothing leads to `goal` itself, to the nearest of the places about it that
  /// something leads to: on a grid of at least three cells' spacing, within `tolerance` (m, at most
  /// 10 steps of that grid) along x and y. For callers that accept such a place.
  [[nodiscard]] Plan plan_near(Point start, Point goal, double tolerance);
  [[nodiscard]] const NavMesh& nav_mesh() const { return nav_mesh_; }

 private:
  struct Anchor;
  /// A plan whose path is the shortest on the mesh.
  struct Route {
    Plan plan;
    mesh::Mesh::Place from = {};  ///< the ends of the path
    mesh::Mesh::Place to = {};
    std::optional<Point> start = {};  ///< a straight leg from here comes before the path
    std::optional<Point> goal = {};   ///< and one to here after it
    bool leaves_hole = false;         ///< the leg from the start
  };
  void carve_latest();
  [[nodiscard]] Plan plan(const PlanRequest& request);
  [[nodiscard]] Plan plan_without_obstacles(const PlanRequest& request, const Plan& blocked);
  [[nodiscard]] Route search(Point start, Point goal) const;
  [[nodiscard]] Route search_retreat(const std::vector<Cylinder>& swept_area, Point start) const;
  [[nodiscard]] Route search_retreat(const std::vector<Cylinder>& swept_area, Point start,
                                     double spare) const;
  [[nodiscard]] static Route route_of(const search::Found& found, const Anchor& from,
                                      const mesh::Mesh::Place& to, Point start, Point goal);
  [[nodiscard]] Plan guided(Route route, const Path& followed) const;
  [[nodiscard]] Path guide_path(const Route& route, const Path& followed) const;
  [[nodiscard]] Guidance::Refusal refusal_of(Point goal) const;
  [[nodiscard]] Anchor anchor(Point point, double within, std::optional<int> part) const;
  [[nodiscard]] Anchor begin(Point start, Point goal, std::optional<int> part) const;

  PlannerConfig config_;
  NavMesh nav_mesh_;
  std::optional<std::vector<Cylinder>> uncarved_;  ///< the latest, until something needs the mesh
  mutable search::Search search_;                  ///< its memory
  smooth::Smoother smoother_;
};

}  // namespace navvi_nav::plan
