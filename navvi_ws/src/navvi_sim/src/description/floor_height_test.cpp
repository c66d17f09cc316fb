#include "description/floor_height.hpp"

#include <gtest/gtest.h>

namespace navvi_sim {
namespace {

Thing box(ThingClass thing_class, const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  Thing thing;
  thing.thing_class = thing_class;
  thing.pose.translation() = centre;
  thing.shapes = {{Box{size}}};
  return thing;
}

TEST(FloorHeight, is_the_top_of_a_slab_on_which_most_things_stand_whatever_its_class) {
  std::vector<Thing> things{box(ThingClass::floor, {0, 0, -0.5}, {24, 24, 1}),
                            box(ThingClass::other, {0, 0, 0}, {14, 14, 0.1}),
                            box(ThingClass::wall, {3, 3, 0.5}, {3, 0.3, 1}),
                            box(ThingClass::wall, {-3, 3, 0.5}, {3, 0.3, 1})};
  EXPECT_NEAR(main_floor_height(things).value(), 0.05, 1e-9);
  for (const double x : {11.0, 11.5, 10.5})
    things.push_back(box(ThingClass::box, {x, 11, 0.5}, {0.3, 0.3, 1}));  // off the slab
  EXPECT_NEAR(main_floor_height(things).value(), 0.0, 1e-9);
}

TEST(FloorHeight, is_the_top_of_a_slab_that_covers_most_though_nothing_stands_on_it) {
  std::vector<Thing> things{box(ThingClass::floor, {0, 0, -0.5}, {24, 24, 1}),
                            box(ThingClass::other, {0, 0, 0}, {20, 20, 0.1})};
  EXPECT_NEAR(main_floor_height(things).value(), 0.05, 1e-9);
  things.push_back(box(ThingClass::box, {11, 11, 0.5}, {0.3, 0.3, 1}));  // off the slab
  EXPECT_NEAR(main_floor_height(things).value(), 0.05, 1e-9);
}

TEST(FloorHeight, is_not_the_top_of_a_platform_in_a_hall) {
  const std::vector<Thing> things{box(ThingClass::floor, {0, 0, -0.5}, {24, 24, 1}),
                                  box(ThingClass::pedestal, {0, 0, 0.05}, {4, 4, 0.1}),
                                  box(ThingClass::box, {0, 0, 0.6}, {1, 1, 1})};
  EXPECT_NEAR(main_floor_height(things).value(), 0.0, 1e-9);
}

TEST(FloorHeight, is_what_things_that_stand_rise_above) {
  WorldDescription world;
  world.floor_height = 1.0;
  world.things = {box(ThingClass::floor, {0, 0, 0.5}, {24, 24, 1}),
                  box(ThingClass::other, {3, 0, 1.04}, {1, 1, 0.08}), Thing{}};
  EXPECT_TRUE(standing_in(world).empty());
  world.things.push_back(box(ThingClass::box, {5, 0, 1.2}, {1, 1, 0.4}));
  ASSERT_EQ(standing_in(world).size(), 1U);
  EXPECT_NEAR(standing_in(world)[0].max().z(), 1.4, 1e-9);
}

}  // namespace
}  // namespace navvi_sim
