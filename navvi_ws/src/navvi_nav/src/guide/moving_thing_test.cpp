#include "navvi_nav/guide/moving_thing.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_nav::guide {
namespace {

MovingThing forklift(double yaw) { return {{7, {3, 4}, 1.35, {0.5, 0}}, yaw, 2.4, 1.1}; }

TEST(MovingThing, is_a_cylinder_where_no_more_is_known_or_wanted) {
  EXPECT_TRUE(cylinders_of({}, 4).empty());
  MovingThing round = forklift(0.3);
  round.length = round.width = 0.0;
  for (const MovingThing& thing : {round, forklift(0.3)}) {
    const auto row = cylinders_of({thing}, thing.length > 0.0 ? 1 : 4);
    ASSERT_EQ(row.size(), 1U);
    EXPECT_EQ(row[0].center, thing.cylinder.center);
    EXPECT_EQ(row[0].radius, thing.cylinder.radius);
  }
}

TEST(MovingThing, stays_a_cylinder_where_a_row_would_not_be_slimmer) {
  EXPECT_EQ(cylinders_of({{{1, {0, 0}, 0.45, {}}, 0.0, 0.6, 0.6}}, 4).size(), 1U);
  EXPECT_EQ(cylinders_of({{{1, {0, 0}, 0.45, {}}, 0.0, 0.61, 0.6}}, 4).size(), 2U);
}

TEST(MovingThing, is_a_row_that_covers_its_rectangle_half_as_wide) {
  for (const double yaw : {0.0, 0.7, M_PI / 2, -2.5}) {
    for (const bool across : {false, true}) {
      MovingThing thing = forklift(yaw);
      if (across) std::swap(thing.length, thing.width);
      const auto row = cylinders_of({thing}, 4);
      ASSERT_EQ(row.size(), 3U);
      for (const Cylinder& one : row) {
        EXPECT_EQ(one.id, 7U);
        EXPECT_EQ(one.velocity, thing.cylinder.velocity);
        EXPECT_LT(one.radius, 0.69);
      }
      const Pose place{thing.cylinder.center, yaw};
      for (double x = -0.5; x <= 0.5; x += 0.05) {
        for (double y = -0.5; y <= 0.5; y += 0.05) {
          const Point inside = to_parent(place, {x * thing.length, y * thing.width});
          double nearest = std::numeric_limits<double>::infinity();
          for (const Cylinder& one : row)
            nearest = std::min(nearest, distance(inside, one.center) - one.radius);
          EXPECT_LE(nearest, 1e-9);
        }
      }
      if (!across) {
        EXPECT_LT(distance(row[0].center, to_parent(place, {1.2, 0.0})), 0.41);  // the front first
      }
    }
  }
}

TEST(MovingThing, has_no_more_cylinders_than_wanted) {
  MovingThing train{{1, {0, 0}, 6.0, {}}, 0.0, 11.0, 1.0};
  EXPECT_EQ(cylinders_of({train}, 4).size(), 4U);
  EXPECT_EQ(cylinders_of({train}, 2).size(), 2U);
  EXPECT_EQ(cylinders_of({train, forklift(0)}, 4).size(), 7U);
}

TEST(MovingThing, is_sound_only_if_its_rectangle_fits) {
  EXPECT_TRUE(forklift(0).sound());
  for (const auto& [length, width] : {std::pair{2.4, 0.0},
                                      {0.0, 1.1},
                                      {-2.4, 1.1},
                                      {2.4, -1.1},
                                      {2.8, 1.1},
                                      {std::numeric_limits<double>::quiet_NaN(), 1.1},
                                      {2.4, std::numeric_limits<double>::infinity()}}) {
    MovingThing thing = forklift(0);
    thing.length = length;
    thing.width = width;
    EXPECT_FALSE(thing.sound()) << length << " x " << width;
  }
}

}  // namespace
}  // namespace navvi_nav::guide

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
