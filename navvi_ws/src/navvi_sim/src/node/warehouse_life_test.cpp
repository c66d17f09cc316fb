// A robot that drives blindly.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "navvi_sim/live/world.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/read/world_source.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "octomap_tree.hpp"
#include "warehouse.hpp"

namespace navvi_sim::node {
namespace {

constexpr double kDoorWidth = 3.0;   // m, of a dock
constexpr double kDoorDepth = 0.12;  // m, that its door stands back in the wall

const occupancy::OccupancyConfig kVoxels{0.10};

TEST(WarehouseLife, a_robot_that_drives_blindly_goes_through_no_wall) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const WorldDescription description = warehouse(seed);
    const octomap::OcTree tree = tree_of(occupancy::occupancy_of(description, kVoxels));
    live::World world(
        description, {},
        scenario::draw_scenario(description, occupancy::voxels_of(description, kVoxels), {}, seed)
            .start,
        seed);
    std::vector<double> doors;  // m, x
    for (const Thing& thing : description.things)
      if (thing.name.rfind("dock_door", 0) == 0) doors.push_back(thing.pose.translation().x());
    ASSERT_EQ(doors.size(), 3u);
    for (int step = 0; step < 12000; ++step) {
      const double t = 0.01 * step;
      ASSERT_EQ(world.step({0.9, 0.6 * std::sin(0.11 * t)}), live::World::Status::running);
      const Eigen::Vector2d at = world.now().robot.position;
      ASSERT_LT(std::abs(at.x()), 25.0 - 0.34) << "seed " << seed;
      ASSERT_LT(at.y(), 15.0 - 0.34) << "seed " << seed;
      // Each dock's door stands kDoorDepth back in the wall.
      const bool at_door = std::any_of(doors.begin(), doors.end(), [&](double x) {
        return std::abs(at.x() - x) < kDoorWidth / 2.0;
      });
      ASSERT_GT(at.y(), -15.0 + 0.34 - (at_door ? kDoorDepth : 0.0))
          << at.transpose() << " seed " << seed;
      ASSERT_FALSE(occupied(tree, at.x(), at.y(), 0.35)) << at.transpose() << " seed " << seed;
    }
  }
}

TEST(WarehouseLife, a_robot_that_drives_blindly_among_meshes_enters_none) {
  const std::filesystem::path path = std::filesystem::path(NAVVI_SHARED_DIR) /
                                     "worlds/aws_small_warehouse/no_roof_small_warehouse.world";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const WorldDescription description = read::load_world({path}).world;
  for (const double yaw : {0.0, 1.57, 3.14, -1.57}) {
    live::World world(description, {}, {{1.0, -9.0}, yaw}, 1);
    std::size_t contacts = 0;
    for (int step = 0; step < 6000; ++step) {
      ASSERT_EQ(world.step({0.9, 0.6 * std::sin(0.0011 * step)}), live::World::Status::running);
      contacts += world.now().contacts.size();
      if (step % 10 != 0) continue;
      for (const navvi_types::NearThing& near : world.proximity(0.1).things)
        ASSERT_GT(near.gap, -0.01) << near.name << " after " << step << " steps at "
                                   << world.now().robot.position.transpose();
    }
    EXPECT_GT(contacts, 0u);
    EXPECT_LT(world.now().robot.position.norm(), 15.0);
  }
}

}  // namespace
}  // namespace navvi_sim::node
