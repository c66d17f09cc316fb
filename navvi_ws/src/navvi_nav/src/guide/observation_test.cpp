#include "guide/observation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_nav::guide {
namespace {

MovingThing thing(double speed) {
  return {7, navvi_types::ThingClass::other, {{3, 4}, 0.0}, {speed, 0}, 0.5, 1.0};
}

TEST(Observation, remembers_since_when_a_thing_stands) {
  Observation observation{ObservationConfig{}};
  observation.set_obstacles({thing(0.0)}, 1.0);
  EXPECT_TRUE(std::isinf(observation.obstacles()[0].stood));  // never seen to move
  observation.set_obstacles({thing(1.0)}, 2.0);
  EXPECT_EQ(observation.obstacles()[0].stood, 0.0);
  observation.set_obstacles({thing(0.1)}, 5.0);
  EXPECT_EQ(observation.obstacles()[0].stood, 3.0);
  observation.set_obstacles({}, 6.0);
  observation.set_obstacles({thing(0.0)}, 7.0);
  EXPECT_TRUE(std::isinf(observation.obstacles()[0].stood));  // another one, for all we know
}

TEST(Observation, drops_obstacles_that_are_too_old) {
  Observation observation{ObservationConfig{}};
  observation.update(50.0);
  EXPECT_FALSE(observation.obstacles_fresh());
  EXPECT_FALSE(observation.obstacles_lost());  // none came yet, so none are lost
  observation.set_obstacles({thing(0.0)}, 50.0);
  observation.update(51.0);
  EXPECT_EQ(observation.obstacles().size(), 1U);
  EXPECT_TRUE(observation.thing(7));
  observation.update(51.1);
  EXPECT_TRUE(observation.obstacles().empty());
  EXPECT_TRUE(observation.thing(7)) << "who waits for it must know what it is";
  EXPECT_TRUE(observation.obstacles_lost());
  EXPECT_FALSE(observation.obstacles_fresh());
  EXPECT_TRUE(observation.obstacles_held());
  observation.update(70.1);
  EXPECT_TRUE(observation.obstacles_lost());
  EXPECT_FALSE(observation.obstacles_held()) << "it need not be there any more";
  observation.set_obstacles({}, 71.0);
  EXPECT_FALSE(observation.thing(7));
  EXPECT_FALSE(observation.obstacles_lost());
  EXPECT_TRUE(observation.obstacles_fresh());
}

TEST(Observation, T1_gives_no_pose_that_is_stale_and_forgets_all_when_time_jumps) {
  Observation observation{ObservationConfig{}};
  EXPECT_FALSE(observation.pose(0.0));
  observation.set_pose({{1, 2}, 0.0}, 10.0);
  EXPECT_TRUE(observation.pose(11.0));
  EXPECT_FALSE(observation.pose(11.1));
  EXPECT_TRUE(observation.last_pose());
  observation.reset_times();
  EXPECT_FALSE(observation.last_pose());
  EXPECT_FALSE(observation.pose(10.0));
}

TEST(Observation, foresees_no_motion_by_a_velocity_that_is_older_than_1_s) {
  Observation observation{ObservationConfig{}};
  observation.set_foresight(2.0);
  observation.set_pose({{1, 2}, 0.0}, 10.0);
  observation.set_velocity({0.5, 0.0});
  observation.update(10.0);
  observation.update(11.0);
  EXPECT_EQ(observation.foreseen()->position.x(), 2.0);
  observation.update(11.1);
  EXPECT_EQ(observation.foreseen()->position.x(), 1.0);
}

}  // namespace
}  // namespace navvi_nav::guide
