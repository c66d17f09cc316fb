#include "physics/proximity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navvi_sim/physics/robot.hpp"

namespace navvi_sim::physics {
namespace {

constexpr double kExact = 1e-4;  // m

Thing thing_of(const Geometry& geometry, const Eigen::Vector3d& centre) {
  Thing thing;
  thing.name = "thing";
  thing.thing_class = ThingClass::box;
  thing.pose.translate(centre);
  thing.shapes.push_back({geometry, Eigen::Isometry3d::Identity()});
  return thing;
}

std::vector<ThingGap> near(const std::vector<Thing>& things) {
  WorldDescription world;
  world.things = things;
  const RobotConfig config;
  return things_near({{0.0, 0.0}, config.radius, config.clearance, config.height}, 5.0,
                     Bodies(world, config.clearance), {});
}

TEST(Proximity, is_empty_in_an_empty_world_and_when_all_is_far) {
  EXPECT_TRUE(near({}).empty());
  EXPECT_TRUE(near({thing_of(Box{{1, 1, 1}}, {5.86, 0, 0.5})}).empty());
  EXPECT_EQ(near({thing_of(Box{{1, 1, 1}}, {5.84, 0, 0.5})}).size(), 1u);
}

TEST(Proximity, of_a_cylinder_and_a_sphere) {
  const auto cylinder = near({thing_of(Cylinder{0.4, 1.0}, {3, 1, 0.5})}).at(0);
  EXPECT_NEAR(cylinder.gap, std::hypot(3.0, 1.0) - 0.4 - 0.35, kExact);
  const auto sphere = near({thing_of(Sphere{0.3}, {-2, 1, 0.3})}).at(0);
  EXPECT_NEAR(sphere.gap, std::hypot(2.0, 1.0) - 0.3 - 0.35, kExact);
}

TEST(Proximity, of_what_hangs_is_level_if_it_is_lower_than_the_headroom_and_else_there_is_none) {
  const auto below = near({thing_of(Box{{1, 1, 0.4}}, {1.85, 0, 0.98})}).at(0);
  EXPECT_NEAR(below.gap, 1.35 - 0.35, kExact);
  EXPECT_TRUE(near({thing_of(Box{{1, 1, 0.4}}, {1.85, 0, 1.0})}).empty());
  // Of a ball and of a slanted plate only what is as low as the robot counts.
  const auto ball = near({thing_of(Sphere{1.0}, {3, 0, 1.4})}).at(0);
  const double top = RobotConfig{}.height;
  EXPECT_NEAR(ball.gap, 3.0 - std::sqrt(1.0 - (1.4 - top) * (1.4 - top)) - 0.35, kExact);
  Thing plate = thing_of(Box{{4, 1, 1e-6}}, {4, 0, 0.8});
  plate.pose.rotate(Eigen::AngleAxisd(std::atan(0.5), Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(near({plate}).at(0).gap, 4.0 + (0.8 - top) / 0.5 - 0.35, kExact);
}

TEST(Proximity, passes_over_floors_and_what_is_driven_over) {
  Thing floor = thing_of(Box{{10, 10, 0.1}}, {0, 0, -0.05});
  floor.thing_class = ThingClass::floor;
  EXPECT_TRUE(near({floor, thing_of(Box{{1, 1, 0.02}}, {1, 0, 0.01})}).empty());
}

TEST(Proximity, of_what_touches_is_zero_or_less) {
  const auto touching = near({thing_of(Box{{1, 1, 1}}, {0.85, 0, 0.5})}).at(0);
  EXPECT_NEAR(touching.gap, 0.0, 1e-3);
  const auto overlapping = near({thing_of(Box{{1, 1, 1}}, {0.845, 0, 0.5})}).at(0);
  EXPECT_NEAR(overlapping.gap, -0.005, 1e-3);
}

TEST(Proximity, gives_each_thing_once_nearest_first) {
  Thing two = thing_of(Box{{0.2, 0.2, 1}}, {0, 3, 0.5});
  two.shapes.push_back({Box{{0.2, 0.2, 1}}, Eigen::Isometry3d(Eigen::Translation3d(0, -1, 0))});
  const auto found = near({thing_of(Sphere{0.5}, {4, 0, 0.5}), two});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].thing, 1u);
  EXPECT_NEAR(found[0].gap, 2.0 - 0.1 - 0.35, kExact);
  EXPECT_EQ(found[1].thing, 0u);
}

}  // namespace
}  // namespace navvi_sim::physics
