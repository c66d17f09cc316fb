#include <gtest/gtest.h>

#include <filesystem>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "sdf_folder.hpp"

namespace navvi_sim::node {
namespace {

/// A world that others wrote, as it is found in the wild.
class AwsWarehouse : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file = std::filesystem::path(NAVVI_SHARED_DIR) /
                                       "worlds/aws_small_warehouse/no_roof_small_warehouse.world";
    if (!std::filesystem::exists(file))
      GTEST_SKIP() << "the world " << file << " is not on this machine";
    loaded_ = read::load_world({file.string()});
  }
  read::LoadedWorld loaded_;
};

TEST_F(AwsWarehouse, has_all_models_at_their_size) {
  const WorldDescription& world = loaded_.world;
  EXPECT_EQ(world.things.size(), 25U);
  EXPECT_EQ(loaded_.notes.size(), 1U) << "nothing is lost but light and physics";
  const auto size_of = [&](const std::string& name) -> Eigen::Vector3d {
    const Thing* thing = read::thing_named(world, "aws_robomaker_warehouse_" + name);
    if (!thing) return Eigen::Vector3d::Zero();
    return read::bounds(*thing).sizes();
  };
  EXPECT_LT((size_of("WallB_01_001") - Eigen::Vector3d(14.0, 20.9, 9.0)).norm(), 0.1);
  EXPECT_LT((size_of("ShelfD_01_001") - Eigen::Vector3d(3.92, 0.88, 2.61)).norm(), 0.1);
  EXPECT_LT((size_of("PalletJackB_01_001") - Eigen::Vector3d(1.16, 0.54, 0.97)).norm(), 0.1);
  int shelves = 0;
  for (const Thing& thing : world.things) shelves += thing.thing_class == ThingClass::shelf ? 1 : 0;
  EXPECT_EQ(shelves, 7);
}

TEST_F(AwsWarehouse, has_the_floor_where_its_ground_mesh_is_level) {
  const Thing* ground = read::thing_named(loaded_.world, "aws_robomaker_warehouse_GroundB_01_001");
  ASSERT_NE(ground, nullptr);
  EXPECT_EQ(ground->thing_class, ThingClass::floor);
  EXPECT_NEAR(loaded_.world.floor_height, read::bounds(*ground).max().z(), 0.01);
}

TEST_F(AwsWarehouse, lets_a_robot_go_from_the_south_to_the_north) {
  const scenario::StartAndGoal scenario = scenario::draw_scenario(
      loaded_.world, occupancy::voxels_of(loaded_.world, {}), {}, 1, Pose2{{1.0, -9.0}, 1.57},
      Eigen::Vector2d(1.0, 6.0));
  EXPECT_GE(scenario.route_length, 15.0 - 0.1);
  EXPECT_LT(scenario.route_length, 25.0);
}

}  // namespace
}  // namespace navvi_sim::node
