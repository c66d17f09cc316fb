#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "navvi_nav/funnel.hpp"
#include "navvi_nav/planner.hpp"
#include "navvi_nav/search.hpp"
#include "plain_detour.hpp"
#include "voxel_warehouse.hpp"

namespace navvi_nav {

struct Query {
  Point start;
  Point goal;
};

/// One map with both meshes of it, and what they are asked.
struct Course {
  static constexpr int kQueries = 300;
  static constexpr double kRoom = 0.6;  ///< m, from the ends of a query to anything
  static constexpr double kNear = 0.5;  ///< m, from such an end to either mesh at most

  explicit Course(double resolution)
      : name(resolution < 0.07 ? " 0.05 m" : " 0.10 m"),
        map(resolution),
        ours(config),
        carved(config),
        plain(map.tree(), config.mesh.robot_radius, config.mesh.robot_height),
        as_far(map.tree(), config.mesh.robot_radius + config.mesh.contour_error * resolution,
               config.mesh.robot_height) {
    ours.set_map(map.tree());
    carved.set_map(map.tree());
    std::mt19937 random(1);
    for (int i = 0; i < kQueries; ++i) {
      const Point start = somewhere(random);
      Point goal = somewhere(random);
      while (component(goal) != component(start)) goal = somewhere(random);
      queries.push_back({start, goal});
    }
  }

  /// A point with room around.
  [[nodiscard]] Point somewhere(std::mt19937& random) const {
    std::uniform_real_distribution<double> x(0.0, VoxelWarehouse::kLength);
    std::uniform_real_distribution<double> y(0.0, VoxelWarehouse::kWidth);
    Point point{x(random), y(random)};
    while (ours.nav_mesh().space().clearance(point) < kRoom) point = {x(random), y(random)};
    return point;
  }
  [[nodiscard]] int component(Point point) const {
    const Floor& floor = *ours.nav_mesh().shared_floor();
    return floor.component(floor.cell_at(point));
  }
  [[nodiscard]] const Mesh& mesh() const { return ours.nav_mesh().mesh(); }
  [[nodiscard]] Mesh::Place place(Point point) const { return *mesh().locate(point, kNear); }
  [[nodiscard]] Path search(const Mesh::Place& from, const Mesh::Place& to) const {
    const Corridor corridor = centroid_astar(mesh(), from, to, config.alpha);
    return corridor.found ? funnel(from.point, to.point, corridor.portals) : Path{};
  }

  PlannerConfig config;
  std::string name;
  VoxelWarehouse map;
  Planner ours;
  Planner carved;  ///< the same mesh, to make holes in
  PlainDetour plain;
  PlainDetour as_far;  ///< plain, but eroded by as much as ours
  std::vector<Query> queries;
  std::pair<Mesh::Place, Mesh::Place> ends;  ///< of the query that is about to be timed
};

}  // namespace navvi_nav
