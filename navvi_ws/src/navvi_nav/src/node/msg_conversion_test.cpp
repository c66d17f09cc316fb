#include "node/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "fuzz_message.hpp"
#include "temp_folder.hpp"

namespace navvi_nav::node {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MsgConversion, reads_an_occupancy_grid_that_lies_flat) {
  nav_msgs::OccupancyGrid msg;
  msg.header.frame_id = "map";
  EXPECT_TRUE(from_msg(msg)) << "a quaternion that was left at 0";
  msg.info.origin.orientation.w = 1.0;
  EXPECT_TRUE(from_msg(msg));
  msg.info.width = 2;
  msg.info.height = 1;
  msg.info.resolution = 0.05F;
  msg.info.origin.position.x = -3.0;
  msg.data = {-1, 100};
  ASSERT_TRUE(from_msg(msg));
  EXPECT_EQ(from_msg(msg)->width, 2);
  EXPECT_DOUBLE_EQ(from_msg(msg)->origin.x, -3.0);
  EXPECT_EQ(from_msg(msg)->cells, (std::vector<std::int8_t>{-1, 100}));
  msg.info.origin.orientation.z = std::sin(0.5);
  msg.info.origin.orientation.w = std::cos(0.5);
  EXPECT_NEAR(from_msg(msg)->yaw, 1.0, 1e-9);
  msg.info.origin.orientation.x = 0.2;
  EXPECT_FALSE(from_msg(msg));
  msg.info.origin.orientation.x = 0.0;
  msg.info.origin.position.y = kNan;
  EXPECT_FALSE(from_msg(msg));
  msg.info.origin.position.y = 0.0;
  msg.info.width = 4000000000U;
  EXPECT_FALSE(from_msg(msg));
}

TEST(FuzzMessages, N9_of_maps_are_taken_or_dropped) {
  nav_msgs::OccupancyGrid grid;
  grid.info.width = grid.info.height = 3;
  grid.info.resolution = 0.05F;
  grid.info.origin.orientation.w = 1.0;
  grid.data.assign(9, 0);
  navvi_test::fuzz_message(grid, [](const nav_msgs::OccupancyGrid& msg) {
    if (const auto taken = from_msg(msg)) static_cast<void>(map::read_grid(*taken, {}));
  });
}

TEST(MsgConversion, says_why_a_map_cannot_be_used) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = "map";
  EXPECT_EQ(error_of(msg, "map"), "");
  EXPECT_EQ(error_of(msg, "world"), "it is in frame 'map', not 'world'");
  msg.data.resize(map::kMaxMapBytes + 1);
  EXPECT_EQ(error_of(msg, "map"), "it is larger than 64 MiB");
}

TEST(MsgConversion, draws_a_closed_zone_with_one_line_and_a_slow_one_with_dashes) {
  const navvi_test::TempFolder folder;
  const map::Zones zones(
      folder.write("zones.yaml",
                   "- {name: press, kind: keep_out, corners: [0, 0, 4, 0, 4, 2]}\n"
                   "- {name: lane, kind: slow, speed: 0.4, corners: [0, 0, 4, 0, 4, 0.1]}\n"));
  const auto markers = to_msg(zones, 1.0, "map", ros::Time(3.0)).markers;
  ASSERT_EQ(markers.size(), 2U);
  using visualization_msgs::Marker;
  EXPECT_EQ(markers[0].type, Marker::LINE_STRIP);
  ASSERT_EQ(markers[0].points.size(), 4U);
  EXPECT_EQ(markers[0].points.front(), markers[0].points.back());
  EXPECT_EQ(markers[0].points[2].y, 2.0);
  EXPECT_NEAR(markers[0].points[0].z, 1.02, 1e-9);
  EXPECT_EQ(markers[1].type, Marker::LINE_LIST);
  ASSERT_EQ(markers[1].points.size(), 2U * (4 + 1 + 4)) << "dashes of 0.5 m, one at least";
  EXPECT_NEAR(markers[1].points[0].x, 0.25, 1e-9);
  EXPECT_NEAR(markers[1].points[1].x, 0.75, 1e-9);
  EXPECT_NE(markers[0].id, markers[1].id);
  EXPECT_EQ(to_msg(map::Zones(), 0.0, "map", ros::Time()).markers.size(), 0U);
}

}  // namespace
}  // namespace navvi_nav::node
