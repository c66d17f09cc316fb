#include "navvi_sim/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "navvi_sim/occupancy.hpp"
#include "navvi_sim/warehouse.hpp"

namespace navvi_sim {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

const ros::Time kStamp(12.5);

void expect_drawable(const MarkerArray& array) {
  std::set<std::pair<std::string, int>> seen;
  for (const Marker& marker : array.markers) {
    EXPECT_TRUE(seen.insert({marker.ns, marker.id}).second) << marker.ns << " " << marker.id;
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_EQ(marker.header.stamp, kStamp);
    EXPECT_EQ(marker.color.a, 1.0F);
    const auto& q = marker.pose.orientation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9);
    EXPECT_GT(marker.scale.x, 0.0);
    if (marker.type == Marker::TRIANGLE_LIST) {
      EXPECT_EQ(marker.points.size() % 3, 0U);
      EXPECT_EQ(marker.points.size(), marker.colors.size());
    }
  }
}

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
  expect_drawable(array);
}

TEST(Scene, shows_what_stands_still_by_class) {
  const MarkerArray array = scene_msg(warehouse(1, {}), kStamp);
  expect_drawable(array);
  std::set<std::string> namespaces;
  for (const Marker& marker : array.markers) namespaces.insert(marker.ns);
  for (const char* ns : {"floor", "wall", "shelf", "box", "pedestal", "worker"})
    EXPECT_EQ(namespaces.count(ns), 1U) << ns;
  EXPECT_EQ(namespaces.count("forklift"), 0U) << "it moves";
}

TEST(Scene, draws_a_box_with_its_faces_outwards_and_where_it_is) {
  WorldDescription world;
  Thing box;
  box.name = "box";
  box.thing_class = ThingClass::box;
  box.pose.translation() = Eigen::Vector3d(1.0, 2.0, -3.0);
  box.pose.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  box.shapes.push_back({Box{{4.0, 2.0, 6.0}}, Eigen::Isometry3d::Identity()});
  world.things = {box};
  const MarkerArray array = scene_msg(world, kStamp);
  ASSERT_EQ(array.markers.size(), 1U);
  const auto& points = array.markers[0].points;
  ASSERT_EQ(points.size(), 36U);
  const Eigen::Vector3d centre(1.0, 2.0, -3.0);
  Eigen::AlignedBox3d bounds;
  const auto at = [&](std::size_t i) {
    return Eigen::Vector3d(points[i].x, points[i].y, points[i].z);
  };
  for (std::size_t i = 0; i < 36; i += 3) {
    for (std::size_t j = 0; j < 3; ++j) bounds.extend(at(i + j));
    const Eigen::Vector3d normal = (at(i + 1) - at(i)).cross(at(i + 2) - at(i));
    EXPECT_GT(normal.dot(at(i) - centre), 0.0) << "triangle " << i / 3;
  }
  EXPECT_LT((bounds.sizes() - Eigen::Vector3d(2.0, 4.0, 6.0)).norm(), 1e-9);
  EXPECT_LT((bounds.center() - centre).norm(), 1e-9);
}

TEST(Scene, is_cut_open_above_walls_and_heads) {
  WorldDescription world;
  world.floor_height = 0.5;
  for (const ThingClass thing_class : {ThingClass::wall, ThingClass::shelf}) {
    Thing thing;
    thing.name = to_string(thing_class);
    thing.thing_class = thing_class;
    thing.pose.translation().z() = 5.0;
    thing.shapes.push_back({Box{{1.0, 1.0, 10.0}}, Eigen::Isometry3d::Identity()});
    world.things.push_back(thing);
  }
  const MarkerArray array = scene_msg(world, kStamp);
  expect_drawable(array);
  for (const Marker& marker : array.markers) {
    double top = 0.0;
    for (const auto& point : marker.points) top = std::max(top, point.z);
    EXPECT_NEAR(top, marker.ns == "wall" ? 1.5 : 3.2, 1e-9) << marker.ns;
  }
}

TEST(MovingScene, keeps_its_ids_and_shows_the_robot_with_its_nose_ahead) {
  const WorldDescription world = warehouse(1, {});
  std::vector<MovingPose> movers;
  for (std::size_t i = 0; i < world.things.size(); ++i)
    if (world.things[i].route) movers.push_back({i, world.things[i].pose});
  RobotBody robot;
  robot.pose.translation() = Eigen::Vector3d(3.0, 4.0, 0.0);
  robot.pose.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  const MarkerArray one = moving_scene_msg(world, movers, robot, kStamp);
  for (MovingPose& mover : movers) mover.pose.translation().x() += 1.0;
  const MarkerArray two = moving_scene_msg(world, movers, robot, kStamp);
  expect_drawable(one);
  ASSERT_EQ(one.markers.size(), two.markers.size());
  for (std::size_t i = 0; i < one.markers.size(); ++i) {
    EXPECT_EQ(one.markers[i].ns, two.markers[i].ns);
    EXPECT_EQ(one.markers[i].id, two.markers[i].id);
  }
  const Marker& nose = one.markers.back();
  EXPECT_EQ(nose.ns, "robot");
  EXPECT_GT(nose.points[0].x, robot.radius) << "over the rim";
  EXPECT_NEAR(nose.pose.orientation.z, std::sin(M_PI / 4.0), 1e-9);
}

TEST(MovingScene, of_nothing_is_the_robot_alone) {
  EXPECT_EQ(moving_scene_msg({}, {}, {}, kStamp).markers.size(), 2U);
  EXPECT_TRUE(scene_msg({}, kStamp).markers.empty());
}

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
