#include "lead/flow.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::lead {
namespace {

TEST(Flow, is_between_the_ears_by_the_angle_and_as_much_as_the_speed) {
  EXPECT_DOUBLE_EQ(flow_of({0.0, 1.0}).left, 0.5);
  EXPECT_DOUBLE_EQ(flow_of({0.0, 1.0}).right, 0.5);
  const haptics::Rumble right = flow_of({kFullTurn / 2.0, 0.5});
  EXPECT_NEAR(right.right / right.left, 3.0, 1e-9);
  EXPECT_NEAR(right.left + right.right, kSlowest + 0.5 * (1.0 - kSlowest), 1e-9);
  EXPECT_DOUBLE_EQ(flow_of({-2.0, 0.3}).right, 0.0);
}

TEST(Flow, never_falls_silent_while_there_is_something_to_do) {
  const haptics::Rumble turn = flow_of({1.5, 0.0});
  EXPECT_NEAR(turn.left + turn.right, kSlowest, 1e-9);
}

}  // namespace
}  // namespace navvi_feedback::lead
