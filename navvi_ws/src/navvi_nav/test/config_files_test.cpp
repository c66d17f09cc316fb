#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "navvi_nav/navigator.hpp"

namespace navvi_nav {
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
  EXPECT_DOUBLE_EQ(paper.planner.mesh.cell_size, 0.2);       // R-NAV-1
  EXPECT_TRUE(paper.planner.mesh.whole_cell_erosion);        // R-NAV-2
  EXPECT_DOUBLE_EQ(paper.planner.mesh.carve_changed, 0.01);  // R-NAV-5
  EXPECT_DOUBLE_EQ(paper.carve_period, 2.0);                 // R-NAV-5
  EXPECT_DOUBLE_EQ(paper.planner.alpha, 1.0);                // R-NAV-6
  EXPECT_DOUBLE_EQ(paper.guidance.waypoint_reached, 1.0);    // R-NAV-8
  EXPECT_DOUBLE_EQ(paper.replan.period, 2.0);                // R-NAV-9
  EXPECT_DOUBLE_EQ(paper.replan.slow_speed, 0.1);            // R-NAV-9
  EXPECT_DOUBLE_EQ(paper.guidance.goal_reached, 1.0);        // R-NAV-11
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
