#include "guide/deadlock.hpp"

#include <gtest/gtest.h>

namespace navvi_nav::guide {
namespace {

MovingThing forklift(double yaw) {
  return {7, navvi_types::ThingClass::forklift, {{5, 0}, yaw}, {0, 0}, 1.35, 2.0, 2.4, 1.1};
}

/// \returns s after which it is due, asked every 0.5 s; 100 if never
double due_after(Deadlock& deadlock, const MovingThing& blocker, double from = 0.0) {
  for (double time = 0.0; time < 100.0; time += 0.5) {
    deadlock.update(from + time, {2, 0.3}, blocker);
    if (deadlock.due()) return time;
  }
  return 100.0;
}

TEST(Deadlock, is_noticed_after_a_while_if_the_thing_faces_the_robot) {
  Deadlock deadlock{DeadlockConfig{}};
  EXPECT_EQ(due_after(deadlock, forklift(kPi)), 10.0);
  EXPECT_EQ(deadlock.due(), 7U);
  deadlock.reset_times();
  EXPECT_EQ(due_after(deadlock, forklift(0.0)), 100.0);
  EXPECT_EQ(due_after(deadlock, forklift(kPi / 2)), 100.0);
}

TEST(Deadlock, begins_anew_when_the_way_was_free_or_another_closes_it) {
  Deadlock deadlock{DeadlockConfig{}};
  deadlock.update(0.0, {2, 0}, forklift(kPi));
  deadlock.update(9.0, {2, 0}, std::nullopt);
  deadlock.update(9.5, {2, 0}, forklift(kPi));
  deadlock.update(18.0, {2, 0}, forklift(kPi));
  EXPECT_FALSE(deadlock.due());
  MovingThing other = forklift(kPi);
  other.id = 8;
  deadlock.update(19.0, {2, 0}, other);
  deadlock.update(21.0, {2, 0}, other);
  EXPECT_FALSE(deadlock.due());
}

TEST(Deadlock, never_is_due_if_no_time_is_set) {
  DeadlockConfig config;
  config.make_room_after = 0.0;
  Deadlock deadlock{config};
  EXPECT_EQ(due_after(deadlock, forklift(kPi)), 100.0);
}

TEST(Deadlock, gives_the_thing_time_to_pass_and_then_lets_it_be) {
  Deadlock deadlock{DeadlockConfig{}};
  for (int time = 0; time < 2; ++time) {
    ASSERT_EQ(due_after(deadlock, forklift(kPi)), 10.0);
    deadlock.yield_to(forklift(kPi));
    EXPECT_EQ(deadlock.yields_to(), 7U);
    deadlock.retreated(100.0);
    EXPECT_FALSE(deadlock.due());
    EXPECT_TRUE(deadlock.waits(119.0));
    EXPECT_FALSE(deadlock.waits(121.0));
    EXPECT_EQ(deadlock.yields_to(), 7U);
  }
  EXPECT_EQ(due_after(deadlock, forklift(kPi)), 100.0);
  deadlock.reset();
  EXPECT_FALSE(deadlock.yields_to());
  EXPECT_EQ(due_after(deadlock, forklift(kPi)), 10.0);
}

TEST(Deadlock, has_retreated_near_the_end_only_where_it_leaves_the_area_free) {
  Deadlock deadlock{DeadlockConfig{}};
  MovingThing small = forklift(kPi);
  small.pose.position = {4, 5};
  small.length = 0.8;
  small.width = 0.6;
  deadlock.yield_to(small);
  EXPECT_FALSE(deadlock.has_retreated({2, 5.7}, {2, 6}));  // it needs 0.5 m, the robot 0.35 m
  EXPECT_TRUE(deadlock.has_retreated({2, 5.9}, {2, 6}));
  EXPECT_TRUE(deadlock.has_retreated({2, 5.7}, {2, 5.8}));  // there is no more room
  EXPECT_FALSE(deadlock.has_retreated({2, 5.9}, {2, 7}));
}

TEST(Deadlock, sweeps_the_area_in_front_of_the_thing) {
  const auto swept = area_swept_by(forklift(kPi));
  const auto needs = [&](Point place) {
    return std::any_of(swept.begin(), swept.end(), [place](const Cylinder& one) {
      return distance(place, one.center) < one.radius;
    });
  };
  EXPECT_TRUE(needs({2, 0.5}));
  EXPECT_TRUE(needs({-3, 0}));
  EXPECT_FALSE(needs({2, 1.2}));
  EXPECT_FALSE(needs({7, 0}));
}

}  // namespace
}  // namespace navvi_nav::guide
