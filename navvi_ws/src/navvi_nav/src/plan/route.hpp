#pragma once

#include <optional>

#include "plan/nav_mesh.hpp"
#include "plan/plan_request.hpp"
#include "search/search.hpp"

namespace navvi_nav::plan {

/// A plan whose path is the shortest on the mesh, and what joins it to where it was asked for.
struct Route {
  Plan plan;
  mesh::Mesh::Place from = {};  ///< the ends of the path
  mesh::Mesh::Place to = {};
  std::optional<Point> start = {};  ///< a straight leg from here comes before the path
  std::optional<Point> goal = {};   ///< and one to here after it
  bool leaves_hole = false;         ///< the leg from the start
};

/// Where a point meets the mesh, and whether the straight way there is clear.
struct Anchor {
  std::optional<mesh::Mesh::Place> place;
  bool joined = false;
  bool leaves_hole = false;
};

/// Finds the shortest routes on a mesh with its holes as they are.
class RouteFinder {
 public:
  /// \param start_snap  m, how far off the mesh a start may lie
  RouteFinder(const NavMesh& nav_mesh, search::Search& search, double start_snap)
      : nav_mesh_(nav_mesh), search_(search), start_snap_(start_snap) {}

  /// To exactly `goal`, or why there is none.
  [[nodiscard]] Route find(Point start, Point goal);
  /// Likewise; but where the map does not show the goal yet, to the place on the robot's floor that
  /// is nearest to it, as the crow flies and whatever moves.
  /// \param followed  a path whose end serves while no place is nearer by 0.5 m; may be empty
  [[nodiscard]] Route find_toward(Point start, Point goal, const Path& followed);
  /// Between two places on the mesh. \param start, goal  for which they stand
  [[nodiscard]] Route between(const Anchor& from, const mesh::Mesh::Place& to, Point start,
                              Point goal);
  /// Where a path from `start` begins; from within a hole, see escape().
  /// \param part  if given, only this part of the mesh counts
  [[nodiscard]] Anchor begin(Point start, Point goal, std::optional<int> part) const;
  [[nodiscard]] const NavMesh& nav_mesh() const { return nav_mesh_; }

 private:
  [[nodiscard]] double radius() const { return nav_mesh_.config().robot_radius; }
  /// Nothing, or why no path to the goal can be found whatever moves.
  [[nodiscard]] std::optional<Plan> refused(Point start, Point goal) const;
  [[nodiscard]] Route find_on_floor(Point start, Point end, bool exactly);
  [[nodiscard]] Guidance::Refusal refusal_of(Point goal) const;
  [[nodiscard]] Guidance::Refusal too_near(Point goal, double distance) const;
  [[nodiscard]] Guidance::Refusal not_joined(Point start, Point goal) const;
  /// m, how far from the goal the mesh may be.
  [[nodiscard]] double near_goal() const;
  [[nodiscard]] Anchor anchor(Point point, double within, std::optional<int> part) const;

  const NavMesh& nav_mesh_;
  search::Search& search_;
  double start_snap_;
};

}  // namespace navvi_nav::plan
