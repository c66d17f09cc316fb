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
  octomap::OcTree read(msg.resolution);
  std::istringstream stream(std::string(msg.data.begin(), msg.data.end()));
  read.readBinaryData(stream);
  EXPECT_EQ(read.size(), map.size());
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    const auto* node = read.search(leaf.getKey(), leaf.getDepth());
    ASSERT_NE(node, nullptr);
    ASSERT_EQ(read.isNodeOccupied(node), map.isNodeOccupied(*leaf));
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

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
