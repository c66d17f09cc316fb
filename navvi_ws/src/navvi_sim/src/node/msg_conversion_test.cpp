#include "navvi_sim/node/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "navvi_sim/occupancy/occupancy.hpp"
#include "octomap_tree.hpp"
#include "warehouse.hpp"

namespace navvi_sim::node {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const ros::Time kStamp(12.5);

Thing box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Thing thing;
  thing.pose.translation() = (low + high) / 2.0;
  thing.shapes.push_back({Box{high - low}, Eigen::Isometry3d::Identity()});
  return thing;
}

TEST(OctomapMessage, is_read_by_octomap_as_the_same_cubes) {
  const occupancy::OccupancyMap map = occupancy::occupancy_of(warehouse(1), {});
  const octomap_msgs::Octomap msg = to_msg(map, kStamp);
  EXPECT_EQ(msg.id, "OcTree");
  EXPECT_TRUE(msg.binary);
  EXPECT_EQ(msg.header.frame_id, "map");
  EXPECT_EQ(msg.resolution, 0.05);
  const octomap::OcTree tree = tree_of({msg.resolution, msg.data});
  auto leaf = tree.begin_leafs();
  map.for_each_cube([&](const occupancy::OccupiedCube& cube) {
    ASSERT_NE(leaf, tree.end_leafs());
    const octomap::OcTreeKey low = leaf.getIndexKey();
    ASSERT_TRUE(tree.isNodeOccupied(*leaf));
    ASSERT_EQ(1 << (tree.getTreeDepth() - leaf.getDepth()), cube.side);
    ASSERT_EQ(low[0], cube.x + occupancy::OccupancyMap::kCenter);
    ASSERT_EQ(low[1], cube.y + occupancy::OccupancyMap::kCenter);
    ASSERT_EQ(low[2], cube.z + occupancy::OccupancyMap::kCenter);
    ++leaf;
  });
  EXPECT_EQ(leaf, tree.end_leafs());
}

TEST(OccupiedCells, have_a_marker_for_each_depth_of_the_tree) {
  WorldDescription world;
  world.things.push_back(box({0.0, 0.0, 0.0}, {0.05, 0.05, 0.05}));
  const MarkerArray array = occupied_cells_msg(occupancy::occupancy_of(world, {}), kStamp);
  ASSERT_EQ(array.markers.size(), 17U);
  std::size_t points = 0;
  for (const Marker& marker : array.markers) {
    points += marker.points.size();
    EXPECT_EQ(marker.action, marker.points.empty() ? Marker::DELETE : Marker::ADD);
  }
  EXPECT_EQ(points, 1U);
  EXPECT_NEAR(array.markers[16].points[0].x, 0.025, 1e-9);
}

TEST(OccupiedCells, of_nothing_are_no_cubes) {
  for (const Marker& marker : occupied_cells_msg(occupancy::occupancy_of({}, {}), kStamp).markers)
    EXPECT_EQ(marker.action, Marker::DELETE);
}

TEST(OccupiedCells, of_a_large_map_are_drawn_coarser_and_cover_the_same) {
  WorldDescription world;
  for (int i = 0; i < 400; ++i)
    world.things.push_back(box({0.1 * i, 0.0, 0.0}, {0.1 * i + 0.05, 0.05, 0.05}));
  const MarkerArray array = occupied_cells_msg(occupancy::occupancy_of(world, {}), kStamp, 100);
  std::size_t points = 0;
  for (const Marker& marker : array.markers) {
    points += marker.points.size();
    for (const auto& point : marker.points) EXPECT_NEAR(point.y, 0.5 * marker.scale.y, 0.03);
  }
  EXPECT_LE(points, 100U);
  EXPECT_GE(points, 50U);
}

TEST(Transforms, put_the_robot_at_floor_height) {
  const auto msg = base_link_msg({3'000'000'000, {{1.0, 2.0}, 0.5 * kPi}, {}, 0.0, -0.09});
  EXPECT_EQ(msg.header.frame_id, "odom");
  EXPECT_EQ(msg.header.stamp, ros::Time(3.0));
  EXPECT_EQ(msg.child_frame_id, "base_link");
  EXPECT_EQ(msg.transform.translation.y, 2.0);
  EXPECT_EQ(msg.transform.translation.z, -0.09);
  EXPECT_NEAR(2.0 * std::atan2(msg.transform.rotation.z, msg.transform.rotation.w), kPi / 2, 1e-12);
}

TEST(Transforms, the_correction_brings_a_drifted_odometry_back_to_the_truth) {
  live::Snapshot now;
  now.robot.position = now.odometry.position = {1.0, 2.0};
  now.robot.yaw = now.odometry.yaw = kPi / 2;
  const auto same = odom_msg(now).transform;
  EXPECT_EQ(same.translation.x, 0.0);
  EXPECT_EQ(same.translation.y, 0.0);
  EXPECT_EQ(same.rotation.w, 1.0);

  now.odometry.position = {4.0, -3.0};
  now.odometry.yaw = -2.5;
  const auto isometry = [](const geometry_msgs::Transform& msg) {
    return Eigen::Translation3d(msg.translation.x, msg.translation.y, msg.translation.z) *
           Eigen::Quaterniond(msg.rotation.w, msg.rotation.x, msg.rotation.y, msg.rotation.z);
  };
  const Eigen::Isometry3d map_to_base =
      isometry(odom_msg(now).transform) *
      isometry(base_link_msg(now.odometry.odometry(-0.09, now.stamp())).transform);
  EXPECT_NEAR((map_to_base.translation() - Eigen::Vector3d(1.0, 2.0, -0.09)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((map_to_base.linear().col(0) - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

const std::vector<live::AppliedCommand> kThree{{0, {0.0, 0.0}, physics::Braking::emergency},
                                               {5, {0.1, 1.0 / 3.0}, physics::Braking::normal},
                                               {6, {-0.0, 0.2}, physics::Braking::normal}};

bool equal(const std::vector<live::AppliedCommand>& a, const std::vector<live::AppliedCommand>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.step == y.step && x.velocity.linear == y.velocity.linear &&
           x.velocity.angular == y.velocity.angular && x.braking == y.braking;
  });
}

TEST(AppliedCommands, come_back_whole_however_they_are_cut_and_repeated) {
  for (const std::vector<std::size_t>& begins :
       {std::vector<std::size_t>{0}, {0, 1, 2}, {0, 0}, {1, 0}}) {
    std::vector<live::AppliedCommand> commands;
    for (const std::size_t first : begins) {
      const bool ok = append(applied_commands_msg(kThree, first, ros::Time(1.0)), commands);
      EXPECT_EQ(ok, first == 0 || !commands.empty()) << first;
    }
    EXPECT_TRUE(equal(commands, kThree));
  }
}

TEST(AppliedCommands, out_of_order_or_not_finite_are_refused_whole) {
  const auto good = applied_commands_msg(kThree, 0, ros::Time(1.0));
  for (const auto& spoil : std::vector<std::function<void(navvi_msgs::AppliedCommand&)>>{
           [](auto& last) { last.step = 5; }, [](auto& last) { last.linear = NAN; },
           [](auto& last) { last.angular = INFINITY; }}) {
    auto bad = good;
    spoil(bad.commands.back());
    std::vector<live::AppliedCommand> commands;
    EXPECT_FALSE(append(bad, commands));
    EXPECT_TRUE(commands.empty());
  }
}

}  // namespace
}  // namespace navvi_sim::node
