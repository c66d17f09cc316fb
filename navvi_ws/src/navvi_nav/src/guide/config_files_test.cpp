#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "guide/navigator.hpp"
#include "small_world.hpp"

namespace navvi_nav::guide {
namespace {

NavigatorConfig read_file(const std::string& name) {
  const std::string path = std::string(NAVVI_NAV_CONFIG_DIR) + "/" + name;
  NavigatorConfig config;
  navvi_config::read(config, navvi_config::load_yaml(path), path);
  return config;
}

TEST(ConfigFiles, default_changes_nothing) {
  EXPECT_DOUBLE_EQ(read_file("default.yaml").planner.mesh.robot_radius, 0.35);
}

TEST(ConfigFiles, paper_holds_the_printed_constants) {
  const NavigatorConfig paper = read_file("paper.yaml");
  EXPECT_DOUBLE_EQ(paper.planner.mesh.cell_size, 0.2);          // R-NAV-1
  EXPECT_TRUE(paper.planner.mesh.whole_cell_erosion);           // R-NAV-2
  EXPECT_EQ(paper.planner.mesh.regions, "watershed");           // R-NAV-3
  EXPECT_DOUBLE_EQ(paper.planner.mesh.carve_changed, 0.01);     // R-NAV-5
  EXPECT_DOUBLE_EQ(paper.carve_period, 2.0);                    // R-NAV-5
  EXPECT_DOUBLE_EQ(paper.planner.alpha, 1.0);                   // R-NAV-6
  EXPECT_DOUBLE_EQ(paper.path.guidance.waypoint_reached, 1.0);  // R-NAV-8
  EXPECT_DOUBLE_EQ(paper.replan.trigger.period, 2.0);           // R-NAV-9
  EXPECT_DOUBLE_EQ(paper.path.guidance.goal_reached, 1.0);      // R-NAV-11
  EXPECT_FALSE(paper.replan.trigger.only_if_it_matters);        // R-NAV-9, every trigger
  EXPECT_EQ(paper.observation.most_cylinders, 1);               // R-NAV-4
  EXPECT_DOUBLE_EQ(paper.replan.keeper.hold_time, 0.0);         // every plan is taken
  EXPECT_DOUBLE_EQ(paper.deadlock.make_room_after, 0.0);
}

/// Coarser cells than the voxels, and an aisle that begins on the border of neither.
TEST(ConfigFiles, paper_finds_a_path_through_an_aisle_of_three_meters) {
  SmallWorld world;
  world.room(16, 9.5).box(3, 0.1, 0, 13, 3.15, 1.5).box(3, 6.15, 0, 13, 9.4, 1.5);
  plan::Planner planner(read_file("paper.yaml").planner);
  ASSERT_EQ(planner.set_map(world.voxels()).error, "");
  const plan::Plan plan = planner.plan({1.5, 2.0}, {14.5, 7.0});
  ASSERT_EQ(plan.status, plan::PlanStatus::found) << plan.detail;
  for (const Point point : points_along(plan.path, 0.02)) {
    for (const auto& block : world.blocks()) EXPECT_GE(distance_to(block, point), 0.35 - 1e-6);
  }
}

TEST(ConfigFiles, paper_leads_along_the_corners_of_the_funnel_alone) {
  const plan::PlannerConfig config = read_file("paper.yaml").planner;
  search::Search search(search::SearchMethod::centroid_astar, config.alpha);
  int turning = 0;
  for (unsigned seed = 0; seed < 15; ++seed) {
    RandomWorld world(seed);
    plan::Planner planner(config);
    ASSERT_EQ(planner.set_map(world.map.voxels()).error, "");
    const mesh::Mesh& mesh = planner.nav_mesh().mesh();
    const auto from = mesh.locate(world.start, 0.0);
    const auto to = mesh.locate(world.goal, 0.0);
    if (!from || !to) continue;
    const plan::Plan plan = planner.plan(world.start, world.goal);
    EXPECT_EQ(plan.path, search.find(mesh, *from, *to).path);
    turning += plan.path.size() > 2;
  }
  EXPECT_GE(turning, 3);
}

}  // namespace
}  // namespace navvi_nav::guide
