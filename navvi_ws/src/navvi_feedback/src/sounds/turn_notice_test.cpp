#include "sounds/turn_notice.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::sounds {
namespace {

/// Ticks of 3 s at 0.8 m/s towards a corner; their side, 1 left. \param turn  rad, clockwise
int ticks(TurnNotice& notice, double turn, double distance, double& side) {
  Observation now;
  now.measured = Velocity{0.8, 0.0};
  now.guidance.emplace();
  now.guidance->turn_angle = turn;
  now.guidance->waypoint = {distance, 0.0};
  now.guidance->waypoint_distance = distance;
  int count = 0;
  for (int i = 0; i < 150; ++i)
    if (const auto play = notice.update(now, true, 0.6, 10.0 + 0.02 * i)) {
      ++count;
      side = play->from.y();
    }
  return count;
}

TEST(TurnNotice, has_a_tick_for_each_30_degrees_from_the_side_of_the_turn_and_comes_once) {
  TurnNotice notice;
  double side = 0.0;
  EXPECT_EQ(ticks(notice, 1.57, 1.5, side), 3);
  EXPECT_EQ(side, -1.0) << "to the right";
  EXPECT_EQ(ticks(notice, 1.57, 1.5, side), 0) << "the same corner";
  EXPECT_EQ(ticks(notice, -0.6, 1.9, side), 0) << "likewise";
  TurnNotice other;
  EXPECT_EQ(ticks(other, -0.6, 1.9, side), 1);
  EXPECT_EQ(side, 1.0);
}

TEST(TurnNotice, does_not_come_for_a_bend_or_a_corner_that_is_far) {
  TurnNotice notice;
  double side = 0.0;
  EXPECT_EQ(ticks(notice, 0.2, 1.5, side), 0);
  EXPECT_EQ(ticks(notice, 1.57, 4.0, side), 0);
}

}  // namespace
}  // namespace navvi_feedback::sounds
