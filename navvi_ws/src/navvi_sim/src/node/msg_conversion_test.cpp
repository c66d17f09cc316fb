#include "navvi_sim/node/msg_conversion.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace navvi_sim::node

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
