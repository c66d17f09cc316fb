#include "navvi_sim/setup/sim_node_config.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

namespace navvi_sim::setup {
namespace {

TEST(SimNodeConfig, takes_start_and_goal_as_lists_of_finite_numbers) {
  SimNodeConfig config;
  EXPECT_FALSE(config.start_pose());
  EXPECT_FALSE(config.goal_point());
  config.start = "1,-9, 1.57";
  config.goal = "1,6";
  EXPECT_EQ(config.start_pose()->position.y(), -9.0);
  EXPECT_EQ(config.start_pose()->yaw, 1.57);
  EXPECT_EQ(config.goal_point()->y(), 6.0);
  for (const char* bad : {"1,2", "1,2,3,4", "a,b,c", "1,2,nan", "1,2,3x", "1,,3", "1,2,3,", ",",
                          "1,2,3] x", "1,2,'3'"}) {
    config.start = bad;
    EXPECT_THROW((void)config.start_pose(), navvi_config::ConfigError) << bad;
  }
}

TEST(SimNodeConfig, describes_itself_within_its_own_ranges) {
  SimNodeConfig config;
  navvi_config::read(config,
                     YAML::Load("{workers: standing, wait_for_robot: true, "
                                "robot: {radius: 0.3}, gate: {timeout: 0.1}}"),
                     "test");
  EXPECT_TRUE(config.life.wait_for_robot);
  EXPECT_EQ(config.gate.timeout, 0.1);
  EXPECT_THROW(navvi_config::read(config, YAML::Load("{robot: {radius: .nan}}"), "test"),
               navvi_config::ConfigError);
  EXPECT_THROW(navvi_config::read(config, YAML::Load("{no_such: 1}"), "test"),
               navvi_config::ConfigError);
}

SimNodeConfig profile(const std::string& name) {
  SimNodeConfig config;
  const std::string path = std::string(NAVVI_SIM_DIR) + "/config/" + name + ".yaml";
  navvi_config::read(config, navvi_config::load_yaml(path), path);
  return config;
}

/// A hash of all that stands and moves, then start and goal.
std::string drawn(SimNodeConfig config, const std::string& world) {
  config.world = world;
  config.seed = 3;
  const WorldDescription loaded = load_world(config).world;
  return world_hash(loaded) + "\n" +
         recipe(config, scenario_of(config, loaded, voxels_of(config, loaded)));
}

TEST(SimNodeConfig, draws_the_same_trial_from_a_seed_in_every_profile) {
  for (const std::string world : {"training", "easy", "warehouse", "busy", "narrow", "maze"})
    EXPECT_EQ(drawn(profile("paper"), world), drawn(profile("default"), world)) << world;
}

}  // namespace
}  // namespace navvi_sim::setup
