#include "plan/nav_mesh.hpp"

#include <gtest/gtest.h>

#include <set>

#include "small_world.hpp"

namespace navvi_nav::plan {
namespace {

constexpr double kRadius = 0.35;

NavMesh mesh_of(SmallWorld& world, const NavMeshConfig& config = {}) {
  NavMesh mesh(config);
  EXPECT_EQ(mesh.set_map(world.voxels()).error, "");
  return mesh;
}

bool walkable(const NavMesh& mesh, Point point) {
  return mesh.mesh().locate(point, 0.0).has_value();
}

bool joined(const NavMesh& mesh, Point a, Point b) {
  const auto from = mesh.mesh().locate(a, 0.3);
  const auto to = mesh.mesh().locate(b, 0.3);
  return from && to &&
         mesh.mesh().polygon(from->polygon).component == mesh.mesh().polygon(to->polygon).component;
}

double area_of(const mesh::Mesh& mesh) {
  double sum = 0.0;
  for (const mesh::Polygon& polygon : mesh.polygons) {
    for (std::size_t k = 2; k < polygon.corners.size(); ++k)
      sum += cross(mesh.at(polygon.corners[k - 1]) - mesh.at(polygon.corners[0]),
                   mesh.at(polygon.corners[k]) - mesh.at(polygon.corners[0])) /
             2;
  }
  return sum;
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

bool equal(const mesh::Mesh& a, const mesh::Mesh& b) {
  if (a.polygons.size() != b.polygons.size()) return false;
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    if (!(a.outline(static_cast<int>(i)) == b.outline(static_cast<int>(i))) ||
        a.polygons[i].portals.size() != b.polygons[i].portals.size())
      return false;
  }
  return true;
}

TEST(NavMesh, refuses_a_map_without_voxels_and_keeps_the_last_one) {
  SmallWorld world;
  world.room(6, 6);
  NavMesh mesh = mesh_of(world);
  EXPECT_FALSE(mesh.set_map(map::Voxels{"", 0.05, {}}).error.empty());
  EXPECT_TRUE(walkable(mesh, {3, 3}));
}

TEST(NavMesh, refuses_a_map_without_room_for_the_robot) {
  SmallWorld world;
  world.floor(0, 0, 0.6, 0.6);
  NavMesh mesh(NavMeshConfig{});
  EXPECT_EQ(mesh.set_map(world.voxels()).error,
            "the map shows no walkable floor; what there is of floor lies at z = 0.00 m (0.4 m^2)");
  EXPECT_TRUE(mesh.empty());
}

TEST(NavMesh, ends_before_the_edge_of_the_floor) {
  SmallWorld world;
  world.floor(0, 0, 4, 4);
  const NavMesh mesh = mesh_of(world);
  EXPECT_TRUE(walkable(mesh, {2, 2}));
  EXPECT_TRUE(walkable(mesh, {0.46, 2}));
  EXPECT_FALSE(walkable(mesh, {0.34, 2}));
}

TEST(NavMesh, takes_a_pedestal_of_one_voxel_for_an_obstacle) {
  for (const double height : {0.05, 0.10, 0.30}) {
    SmallWorld world;
    world.room(8, 8).box(3, 3, 0, 5, 5, height);
    const NavMesh mesh = mesh_of(world);
    EXPECT_FALSE(walkable(mesh, {4, 4})) << height;
    EXPECT_FALSE(walkable(mesh, {2.7, 4})) << height;
    EXPECT_TRUE(walkable(mesh, {2.5, 4})) << height;
  }
}

TEST(NavMesh, passes_under_what_hangs_higher_than_the_robot) {
  SmallWorld world;
  world.room(8, 8).box(3, 0, 1.0, 5, 8, 1.2);
  EXPECT_TRUE(joined(mesh_of(world), {1, 4}, {7, 4}));
  SmallWorld low;
  low.room(8, 8).box(3, 0, 0.6, 5, 8, 0.8);
  EXPECT_FALSE(joined(mesh_of(low), {1, 4}, {7, 4}));
}

TEST(NavMesh, is_not_misled_by_a_roof_or_a_lamp_under_the_floor) {
  SmallWorld world;
  world.room(8, 8).box(0, 0, 3.0, 8, 8, 3.1).box(4, 4, -1.0, 4.5, 4.5, -0.8);
  const NavMesh mesh = mesh_of(world);
  EXPECT_NEAR(mesh.shared_floor()->height(), 0.0, 1e-9);
  EXPECT_TRUE(walkable(mesh, {4, 4}));
}

TEST(NavMesh, closes_a_narrow_door_and_opens_a_wide_one) {
  for (const auto& [width, open] : {std::pair{0.6, false}, {0.9, true}, {1.2, true}}) {
    SmallWorld world;
    world.room(10, 6).box(5, 0, 0, 5.1, 2, 1).box(5, 2 + width, 0, 5.1, 6, 1);
    EXPECT_EQ(joined(mesh_of(world), {2, 3}, {8, 3}), open) << width;
  }
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

TEST(NavMesh, keeps_the_radius_everywhere_and_loses_little_room) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    RandomWorld world(seed);
    NavMesh mesh = mesh_of(world.map);
    mesh.carve(world.cylinders);
    const map::Floor& floor = *mesh.shared_floor();
    double open_area = 0.0;
    for (int y = 0; y < floor.rows(); ++y) {
      for (int x = 0; x < floor.columns(); ++x) {
        const map::Cell cell{floor.origin().x + x, floor.origin().y + y};
        if (floor.gap(cell) < kRadius + 0.05) continue;
        const Point at = floor.center_of(cell);
        bool hole = false;
        for (const Cylinder& c : world.cylinders)
          hole = hole || distance(at, c.center) < c.radius + kRadius + 0.1;
        if (!hole) open_area += floor.cell_size() * floor.cell_size();
      }
    }
    EXPECT_GT(area_of(mesh.mesh()), 0.97 * open_area) << seed;
    for (std::size_t i = 0; i < mesh.mesh().polygons.size(); ++i) {
      Path outline = mesh.mesh().outline(static_cast<int>(i));
      if (outline.empty()) continue;
      outline.push_back(outline.front());
      outline.push_back(mesh.mesh().centroid(static_cast<int>(i)));
      for (const Point point : points_along(outline, 0.02)) {
        for (const auto& block : world.map.blocks())
          ASSERT_GE(distance_to(block, point), kRadius - 1e-6) << seed;
        for (const Cylinder& c : world.cylinders)
          ASSERT_GE(distance(c.center, point), c.radius + kRadius - 1e-6) << seed;
      }
    }
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

TEST(NavMesh, carves_and_heals_to_the_same_mesh) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    RandomWorld world(seed);
    NavMesh mesh = mesh_of(world.map);
    const mesh::Mesh before = mesh.mesh();
    EXPECT_GT(mesh.carve(world.cylinders).polygons_cut, 0);
    EXPECT_FALSE(equal(before, mesh.mesh()));
    mesh.carve({});
    EXPECT_TRUE(equal(before, mesh.mesh())) << seed;
  }
}

TEST(NavMesh, cuts_only_when_a_cylinder_came_moved_or_went) {
  SmallWorld world;
  world.room(32, 24);
  NavMeshConfig config;
  config.carve_moved = 0.1;
  NavMesh mesh = mesh_of(world, config);
  EXPECT_GT(mesh.carve({{1, {4, 4}, 0.3, {}}}).polygons_cut, 0);
  EXPECT_EQ(mesh.carve({{1, {4.05, 4}, 0.3, {}}}).polygons_cut, 0);  // hardly moved
  EXPECT_GT(mesh.carve({{1, {12, 4}, 0.3, {}}}).polygons_cut, 0);
  EXPECT_GT(mesh.carve({}).polygons_cut, 0);
  EXPECT_EQ(mesh.carve({}).polygons_cut, 0);
}

TEST(NavMesh, waits_until_enough_of_the_carved_area_changed) {
  SmallWorld world;
  world.room(16, 8);
  NavMeshConfig config;
  config.carve_changed = 0.5;
  config.carve_moved = 0.0;
  NavMesh mesh = mesh_of(world, config);
  EXPECT_GT(mesh.carve({{1, {4, 4}, 0.5, {}}}).polygons_cut, 0);
  EXPECT_EQ(mesh.carve({{1, {4.1, 4}, 0.5, {}}}).polygons_cut, 0);
  EXPECT_GT(mesh.carve({{1, {6, 4}, 0.5, {}}}).polygons_cut, 0);
}

TEST(NavMesh, rebuilds_only_the_tiles_that_a_new_map_changes) {
  SmallWorld world;
  world.room(32, 24);
  NavMeshConfig config;
  config.tile_size = 8.0;
  NavMesh mesh = mesh_of(world, config);
  EXPECT_EQ(mesh.set_map(world.voxels()).tiles_rebuilt, 0);
  world.box(4, 4, 0, 4.5, 4.5, 0.5);
  EXPECT_EQ(mesh.set_map(world.voxels()).tiles_rebuilt, 1);
  EXPECT_FALSE(walkable(mesh, {4.2, 4.2}));
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
