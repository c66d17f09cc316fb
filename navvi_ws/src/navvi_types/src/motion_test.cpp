#include "navvi_types/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "navvi_types/thing.hpp"

namespace navvi_types {
namespace {

TEST(Pose2, TakesAPointThereAndBack) {
  const Pose2 pose{{2.0, 3.0}, M_PI / 2.0};
  EXPECT_TRUE(pose.to_parent({1.0, 0.0}).isApprox(Eigen::Vector2d(2.0, 4.0)));
  EXPECT_TRUE(pose.to_local({2.0, 4.0}).isApprox(Eigen::Vector2d(1.0, 0.0)));
  EXPECT_EQ(Pose2{}.to_local({1.0, -2.0}), Eigen::Vector2d(1.0, -2.0));
}

TEST(ClockwiseAngle, IsCountedFromTheNose) {
  EXPECT_NEAR(clockwise_angle({}, {1.0, -1.0}), M_PI / 4.0, 1e-9);
  EXPECT_NEAR(clockwise_angle({}, {0.0, 1.0}), -M_PI / 2.0, 1e-9);
  EXPECT_NEAR(clockwise_angle({{1.0, 0.0}, M_PI / 2.0}, {1.0, 5.0}), 0.0, 1e-9);
}

TEST(Contact, IsSeenFromTheRobot) {
  Contact contact;
  contact.point = {1.65, 3.0};
  contact.robot = {{2.0, 3.0}, M_PI / 2.0};  // looks along +y, so -x is its left
  EXPECT_NEAR((contact.seen_from_robot() - Eigen::Vector2d(0.0, 0.35)).norm(), 0.0, 1e-9);
}

TEST(MovingThing, IsSoundWithoutARectangleOrWithOneInItsCylinder) {
  MovingThing thing;
  thing.radius = 0.5;
  EXPECT_TRUE(thing.sound());
  thing.length = 0.8;
  EXPECT_FALSE(thing.sound()) << "no width";
  thing.width = 0.6;
  EXPECT_TRUE(thing.sound());
  thing.width = 0.7;
  EXPECT_FALSE(thing.sound()) << "sticks out";
  thing.width = NAN;
  EXPECT_FALSE(thing.sound());
}

}  // namespace
}  // namespace navvi_types
