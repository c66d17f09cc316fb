// What the OctoMap shows at the robot's height and what the robot can touch are the same, whatever
// the names and classes of things.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "navvi_sim/live/world.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"
#include "navvi_sim/read/world_source.hpp"
#include "octomap_tree.hpp"
#include "physics/proximity.hpp"

namespace navvi_sim::node {
namespace {

constexpr ThingClass kClasses[] = {
    ThingClass::floor,    ThingClass::shelf,        ThingClass::wall,
    ThingClass::box,      ThingClass::pedestal,     ThingClass::worker,
    ThingClass::forklift, ThingClass::pallet_robot, ThingClass::other};

/// Samples of the map in the height of the robot's hull against the bodies, and of the bodies'
/// surfaces against the map.
void expect_agreement(const WorldDescription& world, std::uint64_t seed) {
  const physics::RobotConfig robot;
  const double under = world.floor_height + robot.clearance;
  const double top = world.floor_height + robot.height;
  const octomap::OcTree map = tree_of(occupancy::occupancy_of(world, {}));
  const double voxel = map.getResolution();
  const double lift = std::round(world.floor_height / voxel) * voxel - world.floor_height;
  const physics::Bodies bodies(world, under);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto near = [&](double x, double y, double radius) {
    return physics::things_near({{x, y}, 0.01, under, top}, radius, bodies, {});
  };
  int cells = 0;
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    const double half = leaf.getSize() / 2.0;
    const double z = leaf.getZ() - lift;
    if (z + half < under + 2.0 * voxel || z - half > top - voxel || random() % 20 != 0) continue;
    ++cells;
    const double x = leaf.getX() + half * unit(random);
    const double y = leaf.getY() + half * unit(random);
    ASSERT_FALSE(near(x, y, 2.0).empty())
        << "nothing to touch at " << x << ", " << y << ", where the map is occupied";
  }
  EXPECT_GT(cells, 10);
  Eigen::AlignedBox3d all;
  for (const physics::Body& body : bodies.all()) all.extend(body.bounds);
  int touched = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d at = all.sample();
    for (const physics::ThingGap& thing : near(at.x(), at.y(), 1.0)) {
      const Eigen::Vector3d& p = thing.nearest;
      if (thing.gap <= 0.0 || p.z() < under + 2.0 * voxel || p.z() > top - voxel) continue;
      ++touched;
      bool shown = false;
      for (int k = 0; k < 27 && !shown; ++k)
        shown = occupied(map, p.x() + (k % 3 - 1) * voxel, p.y() + (k / 3 % 3 - 1) * voxel,
                         p.z() + lift + (k / 9 - 1) * voxel);
      ASSERT_TRUE(shown) << "the map shows nothing of '" << world.things[thing.thing].name
                         << "' at " << p.transpose();
    }
  }
  EXPECT_GT(touched, 10);
}

TEST(Tangible, is_all_that_the_map_shows_in_the_worlds_that_ship) {
  for (const char* name : {"warehouse", "busy", "easy", "narrow", "maze", "training"}) {
    SCOPED_TRACE(name);
    WorldDescription world = read::load_world({name, "", 3, read::Workers::standing}).world;
    for (Thing& thing : world.things) thing.route.reset();
    expect_agreement(world, 3);
  }
}

TEST(Tangible, is_all_that_the_map_shows_whatever_its_class) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int round = 0; round < 10; ++round) {
    WorldDescription world;
    world.name = "any";
    for (int i = 0; i < 60; ++i) {
      Thing thing;
      thing.name = "thing" + std::to_string(i);
      thing.thing_class = kClasses[i % 9];
      thing.pose.translation() =
          Eigen::Vector3d(20.0 * unit(random), 20.0 * unit(random), 0.9 * unit(random));
      thing.pose.rotate(Eigen::Quaterniond::UnitRandom());
      Geometry geometry = Box{{0.3 + unit(random), 0.3 + unit(random), 0.3 + unit(random)}};
      if (i % 3 == 1) geometry = Cylinder{0.2 + 0.4 * unit(random), 0.3 + unit(random)};
      if (i % 3 == 2) geometry = Sphere{0.2 + 0.4 * unit(random)};
      thing.shapes.push_back({geometry});
      world.things.push_back(std::move(thing));
    }
    expect_agreement(world, static_cast<std::uint64_t>(round));
  }
}

TEST(Tangible, is_all_that_the_map_shows_in_worlds_that_others_made) {
  const std::filesystem::path folder = std::filesystem::path(NAVVI_SHARED_DIR) / "worlds";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not on this machine";
  expect_agreement(
      read::load_world({(folder / "aws_small_warehouse/no_roof_small_warehouse.world").string()})
          .world,
      1);
}

TEST(Tangible, is_a_thing_that_someone_calls_a_floor) {
  WorldDescription world;
  world.name = "lamp";
  for (const char* name : {"floor", "floor_lamp"}) {
    Thing thing;
    thing.name = name;
    thing.thing_class = ThingClass::floor;
    world.things.push_back(thing);
  }
  world.things[0].shapes.push_back({Box{{20.0, 20.0, 0.1}}});
  world.things[0].pose.translation().z() = -0.05;
  world.things[1].shapes.push_back({Cylinder{0.3, 1.5}});
  world.things[1].pose.translation().z() = 0.75;
  live::World live(world, {}, {{-3.0, 0.0}, 0.0}, 1);
  EXPECT_EQ(live.proximity(5.0).things.size(), 1U) << "the lamp, and not the floor";
  std::vector<navvi_types::Contact> contacts;
  for (int i = 0; i < 600; ++i) {
    ASSERT_EQ(live.step({0.5, 0.0}), live::World::Status::running);
    const auto& now = live.now().contacts;
    contacts.insert(contacts.end(), now.begin(), now.end());
  }
  EXPECT_NEAR(live.now().robot.position.x(), -0.65, 0.01) << "it was driven through";
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].counts.at(ThingClass::wall), 1U);
}

}  // namespace
}  // namespace navvi_sim::node
