#include "map/local_map.hpp"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <Eigen/Geometry>
#include <fstream>
#include <navvi_config/reader.hpp>
#include <sstream>

namespace navvi_perception::map {
namespace {

using Known = LocalMap::Known;

sight::Sight ray(const Eigen::Vector3d& end, double time, double robot_x = 0.0) {
  sight::Sight sight;
  sight.stamp = static_cast<std::int64_t>(time * 1e9);
  sight.robot.position.x() = robot_x;
  sight.origin = {robot_x, 0.0, 0.12};
  sight.hits = {end};
  return sight;
}

octomap::OcTree read(const LocalMap& map) {
  const std::vector<std::int8_t> bytes = map.bytes();
  std::istringstream in(std::string(bytes.begin(), bytes.end()));
  octomap::OcTree tree(map.resolution());
  if (!bytes.empty()) tree.readBinaryData(in);
  return tree;
}

TEST(LocalMap, knows_nothing_at_first) {
  const LocalMap map{MapConfig()};
  EXPECT_EQ(map.at({1.0, 0.0, 0.1}), Known::nothing);
  EXPECT_TRUE(map.bytes().empty());
  EXPECT_TRUE(map.standing({0.0, 0.0}, 5.0).empty());
}

TEST(LocalMap, what_a_ray_met_stands_and_what_it_passed_often_is_clear) {
  LocalMap map{MapConfig()};
  for (int i = 0; i < 3; ++i) map.insert(ray({2.02, 0.02, 0.12}, 1.0 + 0.1 * i));
  EXPECT_EQ(map.at({2.02, 0.02, 0.12}), Known::standing);
  EXPECT_EQ(map.at({1.02, 0.01, 0.12}), Known::clear);
  EXPECT_EQ(map.at({3.0, 0.0, 0.12}), Known::nothing);
  EXPECT_EQ(map.standing({0.0, 0.0}, 5.0), (std::vector<Column>{{40, 0}}));
  const octomap::OcTree tree = read(map);
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(2.02, 0.02, 0.12)));
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(1.02, 0.01, -0.02))) << "the floor below the ray";
}

TEST(LocalMap, an_octomap_is_a_prior_map_of_all_heights) {
  const std::string file = testing::TempDir() + "navvi_prior.bt";
  octomap::OcTree tree(0.1);
  for (double x = -0.95; x < 1.0; x += 0.1)
    for (double y = -0.95; y < 1.0; y += 0.1) tree.updateNode(x, y, -0.05, true);  // the floor
  tree.updateNode(0.55, 0.55, 0.65, true);    // above a lidar's plane
  tree.updateNode(-0.55, 0.55, 1.65, true);   // above the robot
  tree.updateNode(0.55, -0.55, -0.75, true);  // below the floor
  tree.prune();
  for (const char* name : {"navvi_prior.bt", "navvi_prior.ot"}) {
    const std::string path = testing::TempDir() + name;
    ASSERT_TRUE(path == file ? tree.writeBinary(path) : tree.write(path));
    const sight::Prior prior = prior_of(path, MapConfig());
    EXPECT_EQ(prior.width, 20);
    EXPECT_EQ(prior.height, 20);
    const LocalMap map(MapConfig(), prior);
    EXPECT_EQ(map.at({0.55, 0.55, 0.12}), Known::standing);
    EXPECT_EQ(map.at({-0.55, 0.55, 0.4}, false), Known::clear);
    EXPECT_EQ(map.at({0.55, -0.55, 0.4}, false), Known::clear);
    EXPECT_EQ(map.at({1.55, 0.55, 0.4}), Known::nothing);
    EXPECT_EQ(map.standing({0.0, 0.0}, 5.0).size(), 4U);
  }
  EXPECT_THROW((void)prior_of("/no/such.bt", MapConfig()), navvi_config::ConfigError);
  std::ofstream(file) << "no tree";
  EXPECT_THROW((void)prior_of(file, MapConfig()), navvi_config::ConfigError);
}

/// 4 m by 2 m of floor with a wall at its far end, turned about its lower corner at the origin.
sight::Prior strip(double yaw) {
  sight::Prior prior{0.05, {0.0, 0.0}, 80, 40, {}};
  for (int i = 0; i < 80 * 40; ++i) prior.cells.push_back(i % 80 >= 78 ? 100 : 0);
  prior.yaw = yaw;
  return prior;
}

TEST(LocalMap, H4_a_turned_prior_map_lies_as_it_was_turned) {
  for (const double yaw : {0.0, 0.3, 2.0, -2.5}) {
    const LocalMap map(MapConfig(), strip(yaw));
    const auto known = [&](double x, double y) {
      const Eigen::Vector2d at = Eigen::Rotation2Dd(yaw) * Eigen::Vector2d(x, y);
      return map.at({at.x(), at.y(), 0.12});
    };
    EXPECT_EQ(known(3.95, 1.0), Known::standing) << yaw;
    EXPECT_EQ(known(2.0, 1.0), Known::clear) << yaw;
    EXPECT_EQ(known(2.0, -0.2), Known::nothing) << yaw;
    EXPECT_EQ(known(2.0, 2.2), Known::nothing) << yaw;
    EXPECT_EQ(known(-0.2, 1.0), Known::nothing) << yaw;
  }
}

TEST(LocalMap, another_prior_map_replaces_the_first_and_leaves_what_was_seen) {
  LocalMap map(MapConfig(), strip(0.0));
  for (int i = 0; i < 3; ++i) map.insert(ray({2.02, 0.52, 0.12}, 1.0 + 0.1 * i));
  EXPECT_TRUE(map.changed());
  EXPECT_FALSE(map.changed());
  sight::Prior next = strip(0.0);
  next.cells[20 * 80 + 20] = 100;
  map.know(next);
  EXPECT_TRUE(map.changed());
  EXPECT_EQ(map.at({2.02, 0.52, 0.12}), Known::standing) << "seen";
  EXPECT_EQ(map.at({1.02, 1.02, 0.12}), Known::standing) << "of the new map";
  map.know({});
  EXPECT_EQ(map.at({1.02, 1.02, 0.12}), Known::nothing);
  EXPECT_EQ(map.at({2.02, 0.52, 0.12}), Known::standing);
}

TEST(LocalMap, a_ray_without_a_return_contradicts_a_wall_of_the_prior_map) {
  sight::Sight sight = ray({0.0, 0.0, 0.0}, 1.0, 1.0);
  sight.origin.y() = 1.0;
  sight.hits.clear();
  const LocalMap map(MapConfig(), strip(0.0));
  sight.clear = {{3.5, 1.0, 0.12}};
  EXPECT_FALSE(map.contradicts(sight)) << "it ends before the wall";
  sight.clear = {{4.2, 1.0, 0.12}};
  EXPECT_FALSE(map.contradicts(sight)) << "it ends so near the wall that the map may be amiss";
  sight.clear = {{1.0, 9.0, 0.12}, {9.0, 1.0, 0.12}};
  EXPECT_TRUE(map.contradicts(sight));
  EXPECT_FALSE(LocalMap(MapConfig()).contradicts(sight)) << "without a map";
}

TEST(LocalMap, a_thing_that_rays_pass_again_is_gone) {
  LocalMap map{MapConfig()};
  for (int i = 0; i < 10; ++i) map.insert(ray({2.02, 0.02, 0.12}, 1.0 + 0.1 * i));
  for (int i = 0; i < 12; ++i) map.insert(ray({4.02, 0.02, 0.12}, 3.0 + 0.1 * i));
  EXPECT_EQ(map.at({2.02, 0.02, 0.12}), Known::clear);
}

TEST(LocalMap, forgets_in_time_what_is_not_seen_again) {
  MapConfig config;
  config.forget = 5.0;
  LocalMap map(config);
  map.insert(ray({2.02, 0.02, 0.12}, 1.0));
  for (int i = 0; i < 8; ++i) map.insert(ray({-2.02, 0.02, 0.12}, 2.0 + i));
  EXPECT_NE(map.at({2.02, 0.02, 0.12}), Known::standing);
  EXPECT_EQ(map.at({-2.02, 0.02, 0.12}), Known::standing);
}

TEST(LocalMap, keeps_only_what_is_within_its_bound_of_the_robot) {
  LocalMap map{MapConfig()};
  map.insert(ray({2.02, 0.02, 0.12}, 1.0));
  map.insert(ray({22.02, 0.02, 0.12}, 3.0, 20.0));
  EXPECT_EQ(map.at({2.02, 0.02, 0.12}), Known::nothing);
  EXPECT_EQ(map.at({22.02, 0.02, 0.12}), Known::standing);
}

TEST(LocalMap, floor_and_what_is_overhead_do_not_stand) {
  LocalMap map{MapConfig()};
  map.insert(ray({2.02, 0.02, 0.01}, 1.0));
  map.insert(ray({2.02, 0.02, 1.5}, 2.0));
  EXPECT_TRUE(map.standing({0.0, 0.0}, 5.0).empty());
}

TEST(LocalMap, a_prior_map_of_another_resolution_is_kept_whatever_is_seen) {
  sight::Prior prior{0.10, {-1.0, -1.0}, 20, 20, std::vector<std::int8_t>(400, 0)};
  prior.cells[10 * 20 + 15] = 100;  // x 0.5 to 0.6, y 0 to 0.1
  prior.cells[0] = -1;
  LocalMap map(MapConfig(), prior);
  for (int i = 0; i < 20; ++i) map.insert(ray({0.9, 0.05, 0.12}, 1.0 + 0.1 * i));
  EXPECT_EQ(map.at({0.55, 0.05, 0.12}), Known::standing);
  EXPECT_EQ(map.at({-0.5, 0.5, 0.12}), Known::clear);
  EXPECT_EQ(map.at({-0.97, -0.97, 0.12}), Known::nothing);
  const octomap::OcTree tree = read(map);
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(0.57, 0.07, 0.62)));
  EXPECT_TRUE(tree.isNodeOccupied(tree.search(-0.5, 0.5, -0.02)));
  EXPECT_EQ(tree.search(-0.97, -0.97, -0.02), nullptr) << "unknown cells have no floor";
}

}  // namespace
}  // namespace navvi_perception::map
