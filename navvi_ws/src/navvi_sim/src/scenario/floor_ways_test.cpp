#include "scenario/floor_ways.hpp"

#include <gtest/gtest.h>

#include <map>
#include <queue>

#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::scenario {
namespace {

constexpr double kReach = 0.5;  // m
constexpr double kVoxel = 0.1;  // m

void add_box(WorldDescription& world, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Thing& thing = world.things.emplace_back();
  thing.name = "thing " + std::to_string(world.things.size());
  thing.pose.translation() = 0.5 * (low + high);
  thing.shapes.push_back({Box{high - low}, Eigen::Isometry3d::Identity()});
}

/// Floor with holes in it, and boxes on it and above it.
occupancy::OccupancyMap some_map(std::uint64_t seed, double side) {
  Random random(seed);
  WorldDescription world;
  add_box(world, {0, 0, -0.1}, {side, 0.6 * side, 0});
  add_box(world, {0.2 * side, 0.6 * side, -0.1}, {0.7 * side, side, 0});
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d low(random.uniform(0, side), random.uniform(0, side),
                              random.uniform(0, 2));
    const Eigen::Vector3d size(random.uniform(0.1, 1), random.uniform(0.1, 1), 0.3);
    add_box(world, low, low + size);
  }
  return occupancy::occupancy_of(world, occupancy::OccupancyConfig{kVoxel});
}

/// What the voxels say of each column, by its x and y.
struct Columns {
  std::map<std::pair<int, int>, bool> open;  ///< there is floor, and nothing above it

  explicit Columns(const occupancy::OccupancyMap& map) {
    std::map<std::pair<int, int>, bool> blocked;
    map.for_each_cube([&](const occupancy::OccupiedCube& cube) {
      for (int x = cube.x; x < cube.x + cube.side; ++x)
        for (int y = cube.y; y < cube.y + cube.side; ++y) {
          const int top = cube.z + cube.side;
          if (top == 0) open[{x, y}] = true;
          if (top > 0 && cube.z * kVoxel < 1.2) blocked[{x, y}] = true;
        }
    });
    for (const auto& [column, is_blocked] : blocked) open.erase(column);
  }
};

std::pair<int, int> column_of(const Eigen::Vector2d& point, double side = kVoxel) {
  return {static_cast<int>(std::floor(point.x() / side)),
          static_cast<int>(std::floor(point.y() / side))};
}

FloorWays ways_over(const occupancy::OccupancyMap& map) {
  return FloorWays(floor_of(occupancy::voxels_of(map), 0.0, 1.2, kReach));
}

TEST(FloorWays, know_the_clearance_of_each_cell_to_half_a_cell) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const occupancy::OccupancyMap map = some_map(seed, 5.0);
    const FloorWays ways = ways_over(map);
    const Columns columns(map);
    FloorWays::Cells clear;
    for (std::uint32_t cell = 0; cell < ways.size(); ++cell) {
      const Eigen::Vector2d centre = ways.centre(cell);
      const auto [x, y] = column_of(centre);
      double nearest = 1e9;  // m, from the centre to the square of a column
      for (int dx = -8; dx <= 8; ++dx)
        for (int dy = -8; dy <= 8; ++dy)
          if (columns.open.count({x + dx, y + dy}) == 0)
            nearest = std::min(nearest, kVoxel * std::hypot(std::max(0.0, std::abs(dx) - 0.5),
                                                            std::max(0.0, std::abs(dy) - 0.5)));
      const double told = ways.clearance(cell);
      ASSERT_LE(std::min(told, kReach), nearest + 1e-9) << seed;
      ASSERT_GE(told, std::min(nearest, kReach) - 0.5 * kVoxel) << seed;
      if (told >= 0.3) clear.push_back(cell);
    }
    EXPECT_GT(clear.size(), 100u);
    EXPECT_EQ(ways.cells_clear_by(0.3), clear);
  }
}

TEST(FloorWays, finds_ways_as_short_as_a_plain_search_does) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const FloorWays grid = ways_over(some_map(seed, 5.0));
    const FloorWays::Cells clear = grid.cells_clear_by(0.2);
    std::map<std::pair<int, int>, std::size_t> cells;
    for (const std::size_t cell : clear) cells[column_of(grid.centre(cell))] = cell;
    std::map<std::size_t, float> shortest;
    using Entry = std::pair<float, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.push({0.0F, clear.front()});
    while (!open.empty()) {
      const auto [length, cell] = open.top();
      open.pop();
      if (!shortest.emplace(cell, length).second) continue;
      const auto [x, y] = column_of(grid.centre(cell));
      for (int i = 0; i < 9; ++i) {
        const auto next = cells.find({x + i % 3 - 1, y + i / 3 - 1});
        const auto straight = static_cast<float>(kVoxel);
        if (next != cells.end() && i != 4)
          open.push({length + (i % 2 == 1 ? straight : straight * std::sqrt(2.0F)), next->second});
      }
    }
    const FloorWays::Ways ways = grid.ways_from(clear.front(), 0.2);
    std::size_t reached = 0;
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      if (!std::isfinite(ways.length[cell])) continue;
      ++reached;
      ASSERT_EQ(ways.length[cell], shortest.at(cell)) << seed;
    }
    EXPECT_EQ(reached, shortest.size());
  }
}

TEST(FloorWays, of_a_large_map_has_wider_cells_open_where_all_of_their_voxels_are) {
  constexpr double kSide = 165.0;  // m: 1650 x 1650 voxels, too many for cells of one
  const occupancy::OccupancyMap map = some_map(1, kSide);
  const FloorWays grid = ways_over(map);
  const double side = 2.0 * kVoxel;
  ASSERT_DOUBLE_EQ(grid.floor().cell_size(), side);
  const Columns columns(map);
  std::map<std::pair<int, int>, int> count;
  for (const auto& [column, is_open] : columns.open)
    ++count[{column.first >> 1, column.second >> 1}];
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const auto found = count.find(column_of(grid.centre(cell), side));
    ASSERT_EQ(grid.clearance(cell) > 0.0, found != count.end() && found->second == 4);
  }
}

TEST(FloorWays, over_nothing_are_refused) {
  EXPECT_THROW((void)ways_over(occupancy::OccupancyMap(kVoxel, {})), WorldError);
}

TEST(FloorWays, number_the_parts_of_a_floor_that_no_way_joins) {
  WorldDescription world;
  add_box(world, {0, 0, -0.1}, {4, 2, 0});
  add_box(world, {1.9, 0, 0}, {2.1, 2, 1});
  const FloorWays ways = ways_over(occupancy::occupancy_of(world, {kVoxel}));
  const std::vector<std::uint32_t> part = ways.parts(0.3);
  const auto at = [&](double x) { return part[ways.cell_at({x, 1.0})]; };
  EXPECT_NE(at(1.0), 0u);
  EXPECT_NE(at(3.0), 0u);
  EXPECT_NE(at(1.0), at(3.0));
  EXPECT_EQ(at(2.0), 0u);
  EXPECT_EQ(*std::max_element(part.begin(), part.end()), 2u);
}

}  // namespace
}  // namespace navvi_sim::scenario
