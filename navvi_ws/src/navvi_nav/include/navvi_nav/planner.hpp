#pragma once

#include <optional>
#include <set>
#include <string>

#include "navvi_nav/nav_mesh.hpp"
#include "navvi_nav/search.hpp"
#include "navvi_nav/smoothing.hpp"

namespace navvi_nav {

struct PlannerConfig {
  NavMeshConfig mesh;
  SmoothingConfig smoothing;
  std::string search = "exact";
  double alpha = 1.0;
  double start_snap = 0.5;

  void describe(navvi_config::Visitor& visit);
};

enum class PlanStatus {
  found,
  no_map,
  off_mesh,
  refused,
  no_route,
  closed,  ///< only moving things are in the way: the path is that without them
  aside,   ///< likewise, and the path leads off the ground that one of them needs
};

/// Values as in navvi_msgs/Guidance.
enum class Refusal {
  none,
  not_finite,
  unknown_frame,
  inside_obstacle,
  off_the_map,
  unreachable,
};

struct Plan {
  PlanStatus status = PlanStatus::no_map;
  Refusal refusal = Refusal::none;
  Path path;              ///< from the robot (or the mesh next to it) to the goal
  double shortest = 0.0;  ///< m, of the path before smoothing
  std::size_t nodes_expanded = 0;
  std::string detail;  ///< a sentence
};

/// From a map and obstacles to a path: the package in one function, plan().
class Planner {
 public:
  explicit Planner(const PlannerConfig& config);

  /// \param map  anything that NavMesh::set_map takes
  template <typename Map>
  MeshUpdate set_map(const Map& map) {
    return nav_mesh_.set_map(map);
  }
  MeshUpdate carve(const std::vector<Cylinder>& cylinders) { return nav_mesh_.carve(cylinders); }
  /// A path for the robot at `start` to exactly `goal`. Nothing is moved in silence: only a start
  /// off the mesh is taken to the nearest point of it, at most `start_snap` away, and from within a
  /// moving thing's hole the path begins with a straight way out: see way_out().
  [[nodiscard]] Plan plan(Point start, Point goal) const;
  /// plan() while `obstacles` are carved, or, if they alone are in the way, a plan that is closed.
  [[nodiscard]] Plan plan_among(const std::vector<Cylinder>& obstacles, Point start, Point goal);
  /// The shortest path to a place from which a robot leaves `ground` free, and some room to it
  /// where there is, or no_route.
  [[nodiscard]] Plan plan_aside(const std::vector<Cylinder>& ground, Point start) const;
  /// As plan(), but if nothing leads to `goal` itself, to the nearest of the places about it that
  /// something leads to: on a grid of at least three cells' spacing, within `tolerance` (m, at most
  /// 10 steps of that grid) along x and y. For who says that this will do.
  [[nodiscard]] Plan plan_near(Point start, Point goal, double tolerance) const;
  [[nodiscard]] const NavMesh& nav_mesh() const { return nav_mesh_; }

 private:
  struct Anchor;
  [[nodiscard]] Refusal refusal_of(Point goal) const;
  [[nodiscard]] Anchor anchor(Point point, double within, std::optional<int> part) const;
  [[nodiscard]] Anchor begin(Point start, Point goal, std::optional<int> part) const;
  [[nodiscard]] Plan plan_aside(const std::vector<Cylinder>& ground, Point start,
                                double spare) const;
  [[nodiscard]] Plan finish(const Found& found, const Anchor& from, Point start, Point goal) const;
  [[nodiscard]] std::set<int> components_near(Point point, double within) const;

  PlannerConfig config_;
  NavMesh nav_mesh_;
  mutable Search search_;  ///< its memory
};

}  // namespace navvi_nav
