#include "lead/hand.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace navvi_feedback::lead {
namespace {

constexpr double kStep = 0.02;  // s

/// What is felt over some seconds of one course.
struct Row {
  int pulses = 0;
  double left = 0.0, right = 0.0;  ///< the strongest
  double longest = 0.0;            ///< s, of a pulse
};
Row felt(HandPulses& hand, std::optional<Course> course, double seconds) {
  Row row;
  double lasts = 0.0;
  for (double time = 0.0; time < seconds; time += kStep) {
    const haptics::Rumble rumble = hand.update(course, kStep);
    const bool on = rumble.left + rumble.right > 0.0;
    row.pulses += on && lasts == 0.0 ? 1 : 0;
    lasts = on ? lasts + kStep : 0.0;
    row.longest = std::max(row.longest, lasts);
    row.left = std::max(row.left, rumble.left);
    row.right = std::max(row.right, rumble.right);
  }
  return row;
}

TEST(HandPulses, come_the_quicker_the_faster_to_drive) {
  int before = 1000;
  for (const double speed : {1.0, 0.5, 0.2}) {
    HandPulses hand;
    const Row row = felt(hand, Course{0.0, speed}, 9.0);
    EXPECT_LT(row.pulses, before);
    before = row.pulses;
    EXPECT_EQ(row.left, row.right) << "straight on";
    EXPECT_LE(row.longest, 0.16 + kStep);
  }
  EXPECT_GE(before, 9);
}

TEST(HandPulses, have_the_side_to_turn_to_and_two_forces) {
  HandPulses hand;
  const Row little = felt(hand, Course{0.3, 0.5}, 2.0);
  EXPECT_EQ(little.left, 0.0);
  EXPECT_GT(little.right, 0.0);
  const Row much = felt(hand, Course{-0.6, 0.3}, 2.0);
  EXPECT_GT(much.left, little.right);
  EXPECT_LT(much.left, 0.8) << "as hard as a pattern";
}

TEST(HandPulses, have_no_break_on_the_spot_and_are_none_where_the_robot_is_to_stand) {
  HandPulses hand;
  EXPECT_GT(felt(hand, Course{1.5, 0.0}, 2.0).longest, 1.9);
  const Row after = felt(hand, Course{0.0, 1.0}, 0.14);
  EXPECT_EQ(after.pulses, 0) << "the end of the turn is told by a pause";
  EXPECT_EQ(felt(hand, std::nullopt, 1.0).pulses, 0);
  EXPECT_EQ(felt(hand, Course{0.0, 1.0}, 0.05).pulses, 1) << "at once";
}

}  // namespace
}  // namespace navvi_feedback::lead
