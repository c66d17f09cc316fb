#include "navvi_people/people/sighted_driver.hpp"

#include <gtest/gtest.h>

namespace navvi_people::people {
namespace {

constexpr double kStep = 0.02;  // s

/// A driver who has seen this for so many s.
StickAndButtons after(double off, const std::vector<navvi_types::NearThing>& nearby,
                      navvi_types::Guidance::State state = navvi_types::Guidance::State::following,
                      double seconds = 2.0) {
  DrivingConfig config;
  config.faults = false;
  SightedDriver driver(config, 1, 1);
  Sight sight;
  sight.guidance.state = state;
  sight.guidance.steer_angle = off;
  sight.nearby = nearby;
  StickAndButtons hand;
  for (double time = 0.0; time < seconds; time += kStep) hand = driver.update(sight, time, kStep);
  return hand;
}

navvi_types::NearThing ahead(double gap, bool moving) {
  navvi_types::NearThing thing;
  thing.gap = gap;
  thing.nearest = {gap + 0.4, 0.0};
  thing.moving = moving;
  return thing;
}

TEST(SightedDriver, drives_at_the_speed_that_its_hand_likes) {
  const StickAndButtons hand = after(0.0, {});
  EXPECT_NEAR(hand.forward, DrivingConfig{}.cruise, 0.01);
  EXPECT_EQ(hand.left, 0.0);
}

TEST(SightedDriver, turns_to_the_path_and_slows_down_in_bends) {
  EXPECT_GT(after(-0.3, {}).left, 0.1);
  EXPECT_LT(after(0.3, {}).left, -0.1);
  EXPECT_LT(after(0.3, {}).forward, after(0.1, {}).forward);
  EXPECT_EQ(after(1.5, {}).forward, 0.0) << "a large turn is made on the spot";
}

TEST(SightedDriver, keeps_its_distance_from_what_moves_and_waits_where_it_is_to) {
  EXPECT_LT(after(0.0, {ahead(0.9, true)}).forward, after(0.0, {}).forward);
  EXPECT_EQ(after(0.0, {ahead(0.5, true)}).forward, 0.0);
  EXPECT_GT(after(0.0, {ahead(0.3, false)}).forward, 0.0) << "the path leads round what stands";
  EXPECT_EQ(after(0.0, {}, navvi_types::Guidance::State::blocked).forward, 0.0);
}

TEST(SightedDriver, creeps_past_what_waits_beside_its_lane) {
  navvi_types::NearThing worker = ahead(0.1, true);
  worker.nearest = {0.15, 0.41};
  EXPECT_EQ(after(0.0, {worker}).forward, 0.0);
  const double creeps = after(0.0, {worker}, navvi_types::Guidance::State::following, 5.0).forward;
  EXPECT_GT(creeps, 0.0);
  EXPECT_LT(creeps, after(0.0, {}).forward);
  worker.nearest = {0.45, 0.1};
  EXPECT_EQ(after(0.0, {worker}, navvi_types::Guidance::State::following, 5.0).forward, 0.0);
}

TEST(SightedDriver, sees_a_quarter_of_a_second_late) {
  DrivingConfig config;
  config.faults = false;
  SightedDriver driver(config, 1, 1);
  Sight sight;
  sight.guidance.state = navvi_types::Guidance::State::following;
  double time = 0.0;
  for (; time < 2.0; time += kStep) (void)driver.update(sight, time, kStep);
  sight.nearby = {ahead(0.5, true)};
  const double seen = time;
  while (driver.update(sight, time, kStep).forward > 0.0) time += kStep;
  EXPECT_NEAR(time - seen, 0.25, 0.03);
}

}  // namespace
}  // namespace navvi_people::people
