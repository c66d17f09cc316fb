#include "navvi_sim/scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "description/floor_height.hpp"
#include "warehouse.hpp"

namespace navvi_sim::scene {
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
    EXPECT_EQ(marker.color.a, marker.mesh_use_embedded_materials ? 0.0F : 1.0F);
    const auto& q = marker.pose.orientation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1.0, 1e-9);
    EXPECT_GT(std::min({marker.scale.x, marker.scale.y, marker.scale.z}), 0.0);
    if (marker.type == Marker::TRIANGLE_LIST) {
      EXPECT_EQ(marker.points.size(), 3 * marker.colors.size());
      EXPECT_FALSE(marker.points.empty());
    }
    const std::string at_home = "package://navvi_sim";
    if (marker.type == Marker::MESH_RESOURCE) {
      EXPECT_TRUE(
          std::filesystem::exists(NAVVI_SIM_DIR + marker.mesh_resource.substr(at_home.size())));
    }
  }
}

Thing thing_of(ThingClass thing_class, const Geometry& geometry,
               const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  Thing thing;
  thing.name = to_string(thing_class);
  thing.thing_class = thing_class;
  thing.pose.translation() = at;
  thing.shapes.push_back({geometry, Eigen::Isometry3d::Identity()});
  return thing;
}

MarkerArray standing(const WorldDescription& world) {
  const MarkerArray array = Scene(world, {}).standing(kStamp);
  expect_drawable(array);
  return array;
}

/// m, around everything that a marker draws.
Eigen::AlignedBox3d extent(const Marker& marker) {
  Eigen::AlignedBox3d bounds;
  for (const auto& point : marker.points) {
    const Eigen::Vector3d at(point.x, point.y, point.z);
    const Eigen::Vector3d half = 0.5 *
                                 Eigen::Vector3d(marker.scale.x, marker.scale.y, marker.scale.z) *
                                 (marker.type == Marker::CUBE_LIST ? 1.0 : 0.0);
    bounds.extend(at - half);
    bounds.extend(at + half);
  }
  return bounds;
}

TEST(Scene, shows_what_stands_still_by_class) {
  std::set<std::string> namespaces;
  for (const Marker& marker : standing(warehouse(1)).markers) namespaces.insert(marker.ns);
  for (const char* ns : {"floor", "wall", "shelf", "box", "pedestal", "worker"})
    EXPECT_EQ(namespaces.count(ns), 1U) << ns;
  EXPECT_EQ(namespaces.count("forklift"), 0U) << "it moves";
}

TEST(Scene, draws_slanting_and_round_things_with_faces_outwards_and_as_large_as_they_are) {
  struct Drawn {
    Geometry geometry;
    double turn;  ///< rad
    Eigen::Vector3d size;
  };
  for (const Drawn& drawn : {Drawn{Box{{4.0, 2.0, 6.0}}, 0.3, {4.0, 2.0, 6.0}},
                             Drawn{Cylinder{0.5, 2.0}, 0.0, {1.0, 1.0, 2.0}},
                             Drawn{Sphere{0.5}, 0.0, {1.0, 1.0, 1.0}}}) {
    WorldDescription world;
    Thing thing = thing_of(ThingClass::other, drawn.geometry, {1.0, 2.0, -3.0});
    thing.pose.rotate(Eigen::AngleAxisd(drawn.turn, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
    world.things = {thing};
    const MarkerArray array = standing(world);
    ASSERT_EQ(array.markers.size(), 1U);
    const auto& points = array.markers[0].points;
    Eigen::AlignedBox3d bounds;
    for (std::size_t i = 0; i < points.size(); i += 3) {
      Eigen::Matrix3d corners;
      for (int j = 0; j < 3; ++j) {
        const auto& p = points[i + static_cast<std::size_t>(j)];
        corners.col(j) = thing.pose.inverse() * Eigen::Vector3d(p.x, p.y, p.z);
        bounds.extend(corners.col(j));
      }
      const Eigen::Vector3d normal =
          (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
      EXPECT_GT(normal.dot(corners.rowwise().sum()), 0.0) << "triangle " << i / 3;
    }
    EXPECT_LT((bounds.sizes() - drawn.size).norm(), 1e-9);
    EXPECT_LT(bounds.center().norm(), 1e-9);
  }
}

TEST(Scene, is_cut_open_above_walls_and_heads_however_things_are_turned) {
  for (const double yaw : {0.0, 0.5 * kPi, 0.4}) {
    WorldDescription world;
    world.floor_height = 0.5;
    for (const ThingClass thing_class : {ThingClass::wall, ThingClass::other}) {
      world.things.push_back(thing_of(thing_class, Box{{1.0, 2.0, 10.0}}, {0.0, 0.0, 5.0}));
      world.things.back().pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    }
    world.things.push_back(thing_of(ThingClass::box, Box{{1.0, 1.0, 1.0}}, {0.0, 0.0, 4.0}));
    world.things.push_back(thing_of(ThingClass::pedestal, Sphere{0.5}, {0.0, 0.0, 4.0}));
    const MarkerArray array = standing(world);
    ASSERT_EQ(array.markers.size(), 2U) << "what begins above the cut is not drawn";
    for (const Marker& marker : array.markers)
      EXPECT_NEAR(extent(marker).max().z(), marker.ns == "wall" ? 1.5 : 3.2, 1e-9) << marker.ns;
  }
}

TEST(Scene, a_wall_that_is_cut_has_a_top_again_and_a_roof_is_gone) {
  WorldDescription world;
  world.things = {thing_of(ThingClass::wall, Box{{10.0, 0.2, 3.0}}, {0.0, 0.0, 1.5}),
                  thing_of(ThingClass::wall, Box{{10.0, 10.0, 0.2}}, {0.0, 5.0, 3.1})};
  const MarkerArray array = standing(world);
  ASSERT_EQ(array.markers.size(), 1U);
  const auto& points = array.markers[0].points;
  double top = 0.0;  // m^2, at the cut
  for (std::size_t i = 0; i < points.size(); i += 3) {
    if (points[i].z < 1.0 || points[i + 1].z < 1.0 || points[i + 2].z < 1.0) continue;
    top += 0.5 * std::abs((points[i + 1].x - points[i].x) * (points[i + 2].y - points[i].y) -
                          (points[i + 2].x - points[i].x) * (points[i + 1].y - points[i].y));
  }
  EXPECT_NEAR(top, 2.0, 1e-9);
}

TEST(Scene, a_shelf_that_is_a_block_is_drawn_as_a_rack_of_its_size) {
  WorldDescription world;
  world.things = {thing_of(ThingClass::shelf, Box{{1.0, 6.0, 2.0}}, {3.0, 4.0, 1.0})};
  Eigen::AlignedBox3d bounds;
  double volume = 0.0;
  for (const Marker& marker : standing(world).markers) {
    bounds.extend(extent(marker));
    volume += marker.scale.x * marker.scale.y * marker.scale.z *
              static_cast<double>(marker.points.size());
  }
  EXPECT_TRUE(bounds.isApprox(
      Eigen::AlignedBox3d(Eigen::Vector3d(2.5, 1.0, 0.0), Eigen::Vector3d(3.5, 7.0, 2.0)), 1e-9));
  EXPECT_LT(volume, 0.25 * 12.0) << "open";
}

TEST(Scene, the_highest_board_of_a_rack_hides_nothing_from_above) {
  WorldDescription world;
  Thing shelf = thing_of(ThingClass::shelf, Box{{4.0, 1.0, 0.05}});
  for (const double z : {0.7, 1.4}) {
    shelf.shapes.push_back(shelf.shapes[0]);
    shelf.shapes.back().pose.translation().z() = z;
  }
  world.things = {shelf};
  std::map<double, double> area;  // m^2, by height
  for (const Marker& marker : standing(world).markers)
    for (const auto& point : marker.points) area[point.z] += marker.scale.x * marker.scale.y;
  ASSERT_EQ(area.size(), 3U);
  EXPECT_NEAR(area[0.0], 4.0, 1e-9);
  EXPECT_NEAR(area[0.7], 4.0, 1e-9);
  EXPECT_LT(area[1.4], 1.0);
}

TEST(Scene, boxes_on_shelves_stay_within_their_bodies_and_on_their_boards) {
  WorldDescription world = warehouse(1);
  for (Thing& thing : world.things)
    if (thing.thing_class != ThingClass::shelf) thing.shapes.clear();
  world.things.erase(std::remove_if(world.things.begin(), world.things.end(),
                                    [](const Thing& thing) { return thing.shapes.empty(); }),
                     world.things.end());
  std::vector<Eigen::AlignedBox3d> bodies;
  for (const Thing& thing : world.things)
    for (const Shape& shape : thing.shapes)
      if (shape.look) bodies.push_back(bounds_of(shape.geometry, thing.pose * shape.pose));
  std::size_t drawn = 0;
  for (const Marker& marker : standing(world).markers) {
    if (marker.ns != "box") continue;
    for (const auto& point : marker.points) {
      Marker one = marker;
      one.points = {point};
      const Eigen::AlignedBox3d block = extent(one);
      EXPECT_TRUE(std::any_of(bodies.begin(), bodies.end(), [&](const Eigen::AlignedBox3d& body) {
        Eigen::AlignedBox3d roomy(body.min().array() - 1e-9, body.max().array() + 1e-9);
        return roomy.contains(block) && std::abs(body.min().z() - block.min().z()) < 1e-9;
      }));
      ++drawn;
    }
  }
  EXPECT_EQ(drawn, bodies.size());
  EXPECT_GE(drawn, 100U);
}

TEST(Scene, the_number_of_markers_does_not_grow_with_the_world) {
  WorldDescription world;
  for (int i = 0; i < 2000; ++i)
    world.things.push_back(thing_of(ThingClass::other, Box{{0.5 + 0.01 * i, 0.5, 0.5}},
                                    {2.0 * (i % 50), 2.0 * (i / 50), 0.25}));
  const MarkerArray array = standing(world);
  EXPECT_LE(array.markers.size(), 600U);
  std::size_t blocks = 0;
  for (const Marker& marker : array.markers)
    blocks += marker.points.size() / (marker.type == Marker::TRIANGLE_LIST ? 36 : 1);
  EXPECT_EQ(blocks, 2000U);
}

TEST(Scene, very_many_blocks_are_cut_into_tiles_and_none_is_lost) {
  WorldDescription world;
  for (int i = 0; i < 25000; ++i)
    world.things.push_back(thing_of(ThingClass::other, Box{{0.5, 0.5, 0.5}},
                                    {1.0 * (i % 200) - 100.0, 1.0 * (i / 200), 0.25}));
  const MarkerArray array = standing(world);
  EXPECT_GT(array.markers.size(), 8U);
  EXPECT_LE(array.markers.size(), 25U);
  std::size_t blocks = 0;
  for (const Marker& marker : array.markers) {
    blocks += marker.points.size();
    EXPECT_LT(extent(marker).sizes().maxCoeff(), 51.0);
  }
  EXPECT_EQ(blocks, 25000U);
}

/// What moves in a world, where it begins.
live::Snapshot snapshot_of(const WorldDescription& world) {
  live::Snapshot now;
  for (std::size_t id = 0; id < world.things.size(); ++id) {
    if (!world.things[id].route) continue;
    now.movers.push_back(
        {navvi_types::MovingThing{static_cast<std::uint32_t>(id)}, world.things[id].pose});
  }
  return now;
}

TEST(MovingScene, keeps_its_ids_and_shows_the_robot_with_its_nose_ahead) {
  const WorldDescription world = warehouse(1);
  const physics::RobotConfig robot;
  Scene scene(world, robot);
  live::Snapshot now = snapshot_of(world);
  now.robot.position = {3.0, 4.0};
  now.robot.yaw = kPi / 2.0;
  const MarkerArray one = scene.moving(now, kStamp);
  for (MoverState& mover : now.movers) mover.pose.translation().x() += 1.0;
  const MarkerArray two = scene.moving(now, kStamp);
  expect_drawable(one);
  ASSERT_EQ(one.markers.size(), now.movers.size() + 2) << "a model a mover, and the robot";
  ASSERT_EQ(one.markers.size(), two.markers.size());
  for (std::size_t i = 0; i < one.markers.size(); ++i) {
    EXPECT_EQ(one.markers[i].ns, two.markers[i].ns);
    EXPECT_EQ(one.markers[i].id, two.markers[i].id);
  }
  EXPECT_NEAR(two.markers[0].pose.position.x - one.markers[0].pose.position.x, 1.0, 1e-9);
  const Marker& nose = one.markers.back();
  EXPECT_EQ(nose.ns, "robot");
  EXPECT_GT(nose.points[0].x, robot.radius) << "over the rim";
  EXPECT_NEAR(nose.pose.orientation.z, std::sin(kPi / 4.0), 1e-9);
}

TEST(MovingScene, a_model_is_as_large_as_the_body_and_in_its_place) {
  WorldDescription world;
  Thing forklift = thing_of(ThingClass::forklift, Box{{2.0, 1.0, 1.5}}, {5.0, 6.0, 0.0});
  forklift.shapes[0].pose.translation() = Eigen::Vector3d(0.5, 0.0, 0.75);
  forklift.pose.rotate(Eigen::AngleAxisd(kPi / 2.0, Eigen::Vector3d::UnitZ()));
  forklift.route = Route{};
  world.things = {forklift};
  const MarkerArray array = Scene(world, {}).moving(snapshot_of(world), kStamp);
  ASSERT_EQ(array.markers.size(), 3U);
  EXPECT_NEAR(array.markers[0].scale.x, 2.0, 1e-9);
  EXPECT_NEAR(array.markers[0].scale.z, 1.5, 1e-9);
  EXPECT_NEAR(array.markers[0].pose.position.x, 5.0, 1e-9);
  EXPECT_NEAR(array.markers[0].pose.position.y, 6.5, 1e-9);
  EXPECT_NEAR(array.markers[0].pose.position.z, 0.75, 1e-9);
}

TEST(MovingScene, tells_each_of_many_movers_in_turn_and_those_near_the_robot_always) {
  WorldDescription world;
  for (int i = 0; i < 500; ++i) {
    world.things.push_back(
        thing_of(ThingClass::worker, Cylinder{0.25, 1.7}, {i < 10 ? 1.0 * i : 200.0, 0.0, 0.85}));
    world.things.back().route = Route{};
  }
  Scene scene(world, {});
  const live::Snapshot now = snapshot_of(world);
  std::map<int, int> told;
  std::size_t most = 0;
  for (int message = 0; message < 10; ++message) {
    const MarkerArray array = scene.moving(now, kStamp);
    most = std::max(most, array.markers.size());
    for (const Marker& marker : array.markers)
      if (marker.ns == "worker") ++told[marker.id];
  }
  EXPECT_LT(most, 80U);
  ASSERT_EQ(told.size(), 500U);
  for (const auto& [id, times] : told) EXPECT_EQ(times, id < 10 ? 10 : 1) << id;
}

TEST(MovingScene, of_nothing_is_the_robot_alone) {
  const WorldDescription nothing;
  EXPECT_EQ(Scene(nothing, {}).moving({}, kStamp).markers.size(), 2U);
  EXPECT_TRUE(standing(nothing).markers.empty());
}

}  // namespace
}  // namespace navvi_sim::scene
