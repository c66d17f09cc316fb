#include "guide/cylinders.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_nav::guide {
namespace {

MovingThing thing(double radius, double length, double width) {
  MovingThing out;
  out.id = 1;
  out.radius = radius;
  out.length = length;
  out.width = width;
  return out;
}

MovingThing forklift(double yaw) {
  MovingThing out = thing(1.35, 2.4, 1.1);
  out.id = 7;
  out.pose = {{3, 4}, yaw};
  out.velocity = {0.5, 0};
  return out;
}

TEST(Cylinders, are_one_where_no_more_is_known_or_wanted) {
  MovingThing round = forklift(0.3);
  round.length = round.width = 0.0;
  for (const MovingThing& one : {round, forklift(0.3)}) {
    const auto row = cylinders_of(one, one.length > 0.0 ? 1 : 4);
    ASSERT_EQ(row.size(), 1U);
    EXPECT_EQ(row[0].center, (Point{3, 4}));
    EXPECT_EQ(row[0].radius, 1.35);
  }
}

TEST(Cylinders, are_one_where_a_row_would_not_be_slimmer) {
  EXPECT_EQ(cylinders_of(thing(0.45, 0.6, 0.6), 4).size(), 1U);
  EXPECT_EQ(cylinders_of(thing(0.45, 0.61, 0.6), 4).size(), 2U);
}

TEST(Cylinders, are_a_row_that_covers_the_rectangle_half_as_wide) {
  for (const double yaw : {0.0, 0.7, kPi / 2, -2.5}) {
    for (const bool across : {false, true}) {
      MovingThing one = forklift(yaw);
      if (across) std::swap(one.length, one.width);
      const auto row = cylinders_of(one, 4);
      ASSERT_EQ(row.size(), 3U);
      for (const Cylinder& part : row) {
        EXPECT_EQ(part.id, 7U);
        EXPECT_EQ(part.velocity, (Point{0.5, 0}));
        EXPECT_LT(part.radius, 0.69);
      }
      for (double x = -0.5; x <= 0.5; x += 0.05) {
        for (double y = -0.5; y <= 0.5; y += 0.05) {
          const Point inside = to_point(one.pose.to_parent({x * one.length, y * one.width}));
          double nearest = std::numeric_limits<double>::infinity();
          for (const Cylinder& part : row)
            nearest = std::min(nearest, distance(inside, part.center) - part.radius);
          EXPECT_LE(nearest, 1e-9);
        }
      }
      if (!across) {
        const Point front = to_point(one.pose.to_parent({1.2, 0.0}));
        EXPECT_LT(distance(row[0].center, front), 0.41);  // the front first
      }
    }
  }
}

TEST(Cylinders, are_no_more_than_wanted) {
  EXPECT_EQ(cylinders_of(thing(6.0, 11.0, 1.0), 4).size(), 4U);
  EXPECT_EQ(cylinders_of(thing(6.0, 11.0, 1.0), 2).size(), 2U);
}

}  // namespace
}  // namespace navvi_nav::guide
