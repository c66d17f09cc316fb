#include "look/solids.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_rviz::look {
namespace {

using visualization_msgs::Marker;

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
