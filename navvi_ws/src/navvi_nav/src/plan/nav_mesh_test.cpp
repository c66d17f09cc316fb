#include "plan/nav_mesh.hpp"

#include <gtest/gtest.h>

#include <set>

#include "small_world.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kRadius = 0.35;

bool walkable(const NavMesh& mesh, Point point) {
  return mesh.mesh().locate(point, 0.0).has_value();
}

bool joined(const NavMesh& mesh, Point a, Point b) {
  const auto from = mesh.mesh().locate(a, 0.3);
  const auto to = mesh.mesh().locate(b, 0.3);
  return from && to &&
         mesh.mesh().polygon(from->polygon).component == mesh.mesh().polygon(to->polygon).component;
}

/// All polygons, whatever their numbers.
std::set<std::vector<std::pair<double, double>>> outlines(const mesh::Mesh& mesh) {
  std::set<std::vector<std::pair<double, double>>> out;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    std::vector<std::pair<double, double>> outline;
    for (const Point at : mesh.outline(static_cast<int>(i))) outline.emplace_back(at.x, at.y);
    if (!outline.empty()) out.insert(outline);
  }
  return out;
}

TEST(NavMesh, refuses_a_map_without_voxels_and_keeps_the_last_one) {
  SmallWorld world;
  world.room(6, 6);
  NavMesh mesh = mesh_of(world);
  EXPECT_FALSE(mesh.set_map(map::Voxels{"", 0.05, {}}).error.empty());
  EXPECT_TRUE(walkable(mesh, {3, 3}));
}

TEST(NavMesh, ends_before_the_edge_of_the_floor) {
  SmallWorld world;
  world.floor(0, 0, 4, 4);
  const NavMesh mesh = mesh_of(world);
  EXPECT_TRUE(walkable(mesh, {2, 2}));
  EXPECT_TRUE(walkable(mesh, {0.46, 2}));
  EXPECT_FALSE(walkable(mesh, {0.34, 2}));
}

/// Voxels of 0.06 and 0.09 m leave 0.72 m of it, and the robot is 0.70 m wide.
TEST(NavMesh, passes_a_door_of_80_cm_at_every_resolution) {
  for (const double resolution : {0.02, 0.025, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1}) {
    SmallWorld world(resolution);
    world.room(10, 6).box(5, 0, 0, 5.2, 2, 1).box(5, 2.8, 0, 5.2, 6, 1);
    const NavMesh mesh = mesh_of(world);
    EXPECT_TRUE(joined(mesh, {2, 3}, {8, 3})) << resolution;
    const Point beside{5.1, 2.34};
    EXPECT_EQ(walkable(mesh, beside), mesh.shared_floor()->clearance(beside) >= kRadius)
        << resolution;
  }
}

TEST(NavMesh, opens_the_same_door_of_a_grid_wherever_its_cells_lie) {
  for (const double origin : {0.0, -0.02, 3.333}) {
    map::OccupancyGrid grid{100, 60, 0.1, {origin, origin}, 0.0, {}};
    grid.cells.assign(6000, 0);
    for (int y = 0; y < 60; ++y)
      if (y < 26 || y >= 35) grid.cells[static_cast<std::size_t>(100 * y + 50)] = 100;
    NavMesh mesh(NavMeshConfig{});
    ASSERT_EQ(mesh.set_map(grid).error, "");
    EXPECT_TRUE(joined(mesh, {origin + 2, origin + 3}, {origin + 8, origin + 3})) << origin;
  }
}

TEST(NavMesh, joins_its_tiles_without_gaps) {
  SmallWorld world;
  world.room(20, 4);
  NavMeshConfig config;
  config.tile_size = 3.0;
  const NavMesh mesh = mesh_of(world, config);
  EXPECT_TRUE(joined(mesh, {1, 2}, {19, 2}));
  for (const double y : {1.0, 2.0, 2.995, 3.0, 3.005}) {
    for (double x = 1.0; x < 19.0; x += 0.013) ASSERT_TRUE(walkable(mesh, {x, y})) << x;
  }
}

TEST(NavMesh, cuts_only_when_a_cylinder_came_moved_or_went) {
  SmallWorld world;
  world.room(32, 24);
  NavMesh mesh = mesh_of(world);
  EXPECT_GT(mesh.carve({{1, {4, 4}, 0.3, {}}}).polygons_cut, 0);
  EXPECT_EQ(mesh.carve({{1, {4, 4}, 0.3, {1, 0}}}).polygons_cut, 0);  // it is about to move
  EXPECT_GT(mesh.carve({{1, {12, 4}, 0.3, {}}}).polygons_cut, 0);
  EXPECT_GT(mesh.carve({}).polygons_cut, 0);
  EXPECT_EQ(mesh.carve({}).polygons_cut, 0);
}

TEST(NavMesh, waits_until_enough_of_the_carved_area_changed) {
  SmallWorld world;
  world.room(16, 8);
  NavMeshConfig config;
  config.carve_changed = 0.5;
  NavMesh mesh = mesh_of(world, config);
  EXPECT_GT(mesh.carve({{1, {4, 4}, 0.5, {}}}).polygons_cut, 0);
  EXPECT_EQ(mesh.carve({{1, {4.1, 4}, 0.5, {}}}).polygons_cut, 0);
  EXPECT_GT(mesh.carve({{1, {6, 4}, 0.5, {}}}).polygons_cut, 0);
}

TEST(NavMesh, does_not_remember_earlier_maps) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    RandomWorld world(seed);
    NavMeshConfig config;
    config.tile_size = 4.0;
    NavMesh mesh = mesh_of(world.map, config);
    mesh.carve(world.cylinders);
    for (int step = 0; step < 4; ++step) {
      const double x = 1.0 + 0.05 * (37 * step + 11 * seed);
      world.map.box(x, 3 + 2 * step, 0, x + 1, 4 + 2 * step, 0.5);
      const MeshUpdate update = mesh.set_map(world.map.voxels());
      EXPECT_LT(2 * update.tiles_rebuilt, update.tiles);
      world.cylinders[0].center.x += 0.3;
      mesh.carve(world.cylinders);
      NavMesh fresh = mesh_of(world.map, config);
      fresh.carve(world.cylinders);
      EXPECT_EQ(outlines(mesh.mesh()), outlines(fresh.mesh())) << seed;
    }
  }
}

TEST(NavMesh, erodes_by_whole_cells_in_the_papers_profile) {
  SmallWorld world(0.2);
  world.floor(0, 0, 8, 8);
  NavMeshConfig config;
  config.cell_size = 0.2;
  config.whole_cell_erosion = true;
  config.contour_error = 0.0;
  const NavMesh mesh = mesh_of(world, config);
  EXPECT_TRUE(walkable(mesh, {0.41, 4}));
  EXPECT_FALSE(walkable(mesh, {0.39, 4}));
}

}  // namespace
}  // namespace navvi_nav::plan
