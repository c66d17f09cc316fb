// The warehouse, alive for ten minutes.

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

constexpr double kMinutes = 10.0;
constexpr double kDoorWidth = 3.0;   // m, of a dock
constexpr double kDoorDepth = 0.12;  // m, that its door stands back in the wall

const occupancy::OccupancyConfig kVoxels{0.10};

struct Life {
  explicit Life(std::uint64_t seed, double off_routes = 0.0)
      : description(warehouse(seed)),
        tree(tree_of(occupancy::occupancy_of(description, kVoxels))),
        world(description, {}, start(seed, off_routes), seed) {}

  /// A drawn start that is farther than `distance` from every route.
  [[nodiscard]] Pose2 start(std::uint64_t seed, double distance) const {
    const navvi_floor::Voxels voxels = occupancy::voxels_of(description, kVoxels);
    for (;; ++seed) {
      const Pose2 pose = scenario::draw_scenario(description, voxels, {}, seed).start;
      if (distance_to_routes(pose.position) > distance) return pose;
    }
  }
  [[nodiscard]] double distance_to_routes(const Eigen::Vector2d& point) const {
    double least = 1e9;
    for (const Thing& thing : description.things) {
      if (!thing.route) continue;
      const auto& corners = thing.route->waypoints;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d from = corners[i].at;
        const Eigen::Vector2d along = corners[(i + 1) % corners.size()].at - from;
        const double share = std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (from + share * along - point).norm());
      }
    }
    return least;
  }

  WorldDescription description;
  octomap::OcTree tree;
  live::World world;
};

TEST(WarehouseLife, its_movers_keep_moving_and_never_meet) {
  Life life(1, 2.0);
  const std::size_t count = life.world.now().movers.size();
  ASSERT_GE(count, 4u);
  std::vector<double> minute(count, 0.0);
  for (int step = 1; step <= static_cast<int>(kMinutes * 6000.0); ++step) {
    ASSERT_EQ(life.world.step({}), live::World::Status::running);
    const auto& movers = life.world.now().movers;
    for (std::size_t a = 0; a < count; ++a) {
      minute[a] += movers[a].thing.velocity.norm() * 0.01;
      for (std::size_t b = 0; b < a; ++b)
        ASSERT_GT((movers[a].pose.translation() - movers[b].pose.translation()).head<2>().norm(),
                  0.6)
            << life.description.things[movers[a].thing.id].name << " in "
            << life.description.things[movers[b].thing.id].name << " at " << life.world.now().time;
    }
    if (step % 6000 != 0) continue;
    for (std::size_t a = 0; a < count; ++a)
      EXPECT_GT(minute[a], 2.0) << life.description.things[movers[a].thing.id].name << " by "
                                << life.world.now().time << " s, at "
                                << movers[a].pose.translation().transpose() << ", the robot at "
                                << life.world.now().robot.position.transpose();
    minute.assign(count, 0.0);
  }
}

TEST(WarehouseLife, its_movers_pass_through_nothing_that_stands) {
  Life life(2);
  for (int step = 1; step <= 30000; ++step) {
    ASSERT_EQ(life.world.step({}), live::World::Status::running);
    if (step % 20 != 0) continue;
    for (const MoverState& mover : life.world.now().movers) {
      const Eigen::Vector3d at = mover.pose.translation();
      ASSERT_FALSE(occupied(life.tree, at.x(), at.y(), life.description.floor_height + 0.35))
          << life.description.things[mover.thing.id].name << " at " << at.transpose();
    }
  }
}

TEST(WarehouseLife, a_robot_that_drives_blindly_goes_through_no_wall) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Life life(seed);
    std::vector<double> doors;  // m, x
    for (const Thing& thing : life.description.things)
      if (thing.name.rfind("dock_door", 0) == 0) doors.push_back(thing.pose.translation().x());
    ASSERT_EQ(doors.size(), 3u);
    for (int step = 0; step < 12000; ++step) {
      const double t = 0.01 * step;
      ASSERT_EQ(life.world.step({0.9, 0.6 * std::sin(0.11 * t)}), live::World::Status::running);
      const Eigen::Vector2d at = life.world.now().robot.position;
      ASSERT_LT(std::abs(at.x()), 25.0 - 0.34) << "seed " << seed;
      ASSERT_LT(at.y(), 15.0 - 0.34) << "seed " << seed;
      // Each dock's door stands kDoorDepth back in the wall.
      const bool at_door = std::any_of(doors.begin(), doors.end(), [&](double x) {
        return std::abs(at.x() - x) < kDoorWidth / 2.0;
      });
      ASSERT_GT(at.y(), -15.0 + 0.34 - (at_door ? kDoorDepth : 0.0))
          << at.transpose() << " seed " << seed;
      ASSERT_FALSE(occupied(life.tree, at.x(), at.y(), 0.35)) << at.transpose() << " seed " << seed;
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
