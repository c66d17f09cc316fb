#include "navvi_sim/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "navvi_sim/occupancy.hpp"
#include "navvi_sim/warehouse.hpp"

namespace navvi_sim {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const ros::Time kStamp(12.5);

TEST(OctomapMessage, carries_the_map_bit_by_bit) {
  const WorldDescription world = warehouse(1, {});
  const octomap::OcTree map = occupancy_of(world, {});
  const octomap_msgs::Octomap msg = to_msg(map, kStamp);
  EXPECT_EQ(msg.id, "OcTree");
  EXPECT_TRUE(msg.binary);
  EXPECT_EQ(msg.header.frame_id, "map");
  const auto read = from_msg(msg);
  EXPECT_EQ(read->size(), map.size());
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    const auto* node = read->search(leaf.getKey(), leaf.getDepth());
    ASSERT_NE(node, nullptr);
    ASSERT_EQ(read->isNodeOccupied(node), map.isNodeOccupied(*leaf));
  }
}

TEST(OccupiedCells, have_a_marker_for_each_depth_of_the_tree) {
  octomap::OcTree map(0.05);
  map.updateNode(octomap::point3d(0.02F, 0.02F, 0.02F), true);
  map.updateNode(octomap::point3d(1.02F, 0.02F, 0.02F), false);
  const MarkerArray array = occupied_cells_msg(map, kStamp);
  ASSERT_EQ(array.markers.size(), 17U);
  std::size_t points = 0;
  for (const Marker& marker : array.markers) {
    points += marker.points.size();
    EXPECT_EQ(marker.action, marker.points.empty() ? Marker::DELETE : Marker::ADD);
  }
  EXPECT_EQ(points, 1U);
  EXPECT_NEAR(array.markers[16].points[0].x, 0.025, 1e-9);
}

TEST(OccupiedCells, of_a_large_map_are_drawn_coarser_and_cover_the_same) {
  octomap::OcTree map(0.05);
  for (int i = 0; i < 400; ++i) {
    const auto at = static_cast<float>(0.1 * i);
    map.updateNode(octomap::point3d(at, 0.02F, 0.02F), true);
  }
  const MarkerArray array = occupied_cells_msg(map, kStamp, 100);
  std::size_t points = 0;
  for (const Marker& marker : array.markers) {
    points += marker.points.size();
    for (const auto& point : marker.points) EXPECT_NEAR(point.y, 0.5 * marker.scale.y, 0.03);
  }
  EXPECT_LE(points, 100U);
  EXPECT_GE(points, 50U);
}

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
