#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <ctime>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "plain_tile_cache.hpp"
#include "plan/planner.hpp"

namespace navvi_nav::bench {

/// A warehouse hall as a map: floor at z = 0, walls, shelves of 10 x 1 m in rows, aisles of 3 m
/// between rows and bays. Its south-west corner is the origin of map; all edges lie on voxels of
/// 0.1 m.
struct Hall {
  double length = 50.0;  ///< m, along x, the shelves' direction
  double width = 30.0;   ///< m, along y
  /// m^2 of floor for one box or pedestal at a random place; 0: none, all aisles alike
  double clutter = 0.0;
  std::uint32_t seed = 1;   ///< of the clutter and the queries
  double resolution = 0.1;  ///< m

  [[nodiscard]] std::string name() const;  ///< as in "100 x 100 m cluttered"
  [[nodiscard]] octomap::OcTree map() const;
};

struct Query {
  Point start;
  Point goal;
};

/// s, of the processor, by this thread unless told otherwise
[[nodiscard]] double now(clockid_t clock = CLOCK_THREAD_CPUTIME_ID);

/// One hall with the meshes that are made of it, and what they are asked.
struct Course {
  static constexpr int kQueries = 500;
  static constexpr double kRoom = 0.65;  ///< m, from the ends of a query to anything
  static constexpr double kNear = 0.5;   ///< m, from such an end to a mesh at most

  explicit Course(const Hall& hall);

  /// `count` discs of 0.5 m at random places of the floor.
  [[nodiscard]] std::vector<Cylinder> discs(int count) const;
  [[nodiscard]] double floor_area() const;  ///< m^2, of our mesh

  std::string name;
  std::uint32_t seed;
  plan::PlannerConfig config;
  octomap::OcTree tree;
  std::vector<std::int8_t> bytes;          ///< the tree as octomap_msgs carries it, binary
  std::vector<std::int8_t> changed_bytes;  ///< the same with one box more
  plan::Planner carved;  ///< its mesh, to make holes in
  plain::Columns columns;
  int tile = 0;  ///< cells, of TileCache's tiles: the fastest
  std::map<int, double>
      tiles_tried;  ///< by that size, ms for 50 discs moved and a path; infinite where it fails
  std::unique_ptr<plain::TileCache> tile_cache;
  std::unique_ptr<plain::Query> tile_cache_query;
  std::vector<Query> queries;
  std::vector<Query> across;  ///< the tenth of them whose ends are farthest apart

 private:
  void choose_tile();
  [[nodiscard]] Point somewhere(std::mt19937& random) const;
  [[nodiscard]] int component(Point point) const;
};

}  // namespace navvi_nav::bench
