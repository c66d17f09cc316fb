#include "look/skyline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_rviz::look {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// A cube of 1 m, 2 m high, with its middle at (x, 0).
MarkerArray rack(double x, const char* ns = "shelf") {
  Marker marker;
  marker.ns = ns;
  marker.type = Marker::CUBE_LIST;
  marker.scale.x = marker.scale.y = 1.0;
  marker.scale.z = 2.0;
  marker.points.resize(1);
  marker.points[0].x = x;
  marker.points[0].z = 1.0;
  MarkerArray array;
  array.markers = {marker};
  return array;
}

const Eigen::Vector3d kRobot(0.0, 0.0, 0.3);
const Eigen::Vector2d kBack(-1.0, 0.0);

TEST(Skyline, of_nothing_is_flat) {
  EXPECT_EQ(Skyline().slope_over(kRobot, kBack, 6.0), 0.0);
  EXPECT_EQ(Skyline(rack(-2.0, "floor")).slope_over(kRobot, kBack, 6.0), 0.0);
}

TEST(Skyline, a_rack_behind_asks_for_a_look_over_its_nearer_edge) {
  const double slope = Skyline(rack(-2.0)).slope_over(kRobot, kBack, 6.0);
  EXPECT_GT(slope, 1.7 / 1.5 - 0.01);
  EXPECT_LT(slope, 1.7 / 1.2);
}

TEST(Skyline, what_stands_ahead_beside_or_far_away_asks_for_nothing) {
  EXPECT_EQ(Skyline(rack(2.0)).slope_over(kRobot, kBack, 6.0), 0.0);
  EXPECT_EQ(Skyline(rack(-9.0)).slope_over(kRobot, kBack, 6.0), 0.0);
  EXPECT_EQ(Skyline(rack(-2.0)).slope_over({0.0, 1.0, 0.3}, kBack, 6.0), 0.0);
}

TEST(Skyline, triangles_stand_where_cubes_do) {
  Marker marker = rack(0.0).markers[0];
  marker.type = Marker::TRIANGLE_LIST;
  marker.points.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    marker.points[i].x = -2.0 - 0.1 * static_cast<double>(i);
    marker.points[i].y = i == 0 ? -0.5 : 0.5;
    marker.points[i].z = 2.0;
  }
  MarkerArray array;
  array.markers = {marker};
  EXPECT_GT(Skyline(array).slope_over(kRobot, kBack, 6.0), 0.8);
}

Marker marker(int type) {
  Marker msg;
  msg.type = type;
  msg.scale.x = 2.0;
  msg.scale.y = 1.0;
  msg.scale.z = 0.5;
  msg.pose.position.x = 10.0;
  return msg;
}

TEST(Solids, a_model_that_is_turned_fills_its_turned_box) {
  Marker msg = marker(Marker::MESH_RESOURCE);
  msg.pose.orientation.z = msg.pose.orientation.w = std::sqrt(0.5);
  const auto found = solids(msg);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].min().isApprox(Eigen::Vector3d(9.5, -1.0, -0.25)));
  EXPECT_TRUE(found[0].max().isApprox(Eigen::Vector3d(10.5, 1.0, 0.25)));
}

TEST(Solids, of_a_list_are_its_cubes_or_triangles) {
  Marker cubes = marker(Marker::CUBE_LIST);
  cubes.points.resize(2);
  cubes.points[1].y = 3.0;
  ASSERT_EQ(solids(cubes).size(), 2u);
  EXPECT_TRUE(solids(cubes)[1].center().isApprox(Eigen::Vector3d(10.0, 3.0, 0.0)));
  Marker triangles = cubes;
  triangles.type = Marker::TRIANGLE_LIST;
  triangles.points.resize(3);
  triangles.points[2].x = 1.0;
  ASSERT_EQ(solids(triangles).size(), 1u);
  EXPECT_TRUE(solids(triangles)[0].max().isApprox(Eigen::Vector3d(11.0, 3.0, 0.0)));
}

TEST(Solids, a_ring_fills_what_is_within) {
  Marker ring = marker(Marker::LINE_STRIP);
  ring.points.resize(3);
  ring.points[1].x = 1.0;
  ring.points[2].y = 2.0;
  ASSERT_EQ(solids(ring).size(), 1u);
  EXPECT_TRUE(solids(ring)[0].max().isApprox(Eigen::Vector3d(11.0, 2.0, 0.0)));
}

TEST(Solids, words_and_what_is_gone_fill_nothing) {
  EXPECT_TRUE(solids(marker(Marker::TEXT_VIEW_FACING)).empty());
  Marker gone = marker(Marker::CUBE);
  gone.action = Marker::DELETE;
  EXPECT_TRUE(solids(gone).empty());
}

}  // namespace

}  // namespace navvi_rviz::look
