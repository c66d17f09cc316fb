#include "lead/following.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::lead {
namespace {

constexpr double kStep = 0.02;  // s

/// Seconds of a turn to the right that is shown, with a robot that turns at so many rad/s.
bool follows_after(double seconds, double rate, double shown = 0.6) {
  Following following;
  for (double time = 0.0; time < seconds; time += kStep)
    following.update(shown, {0.0, rate}, time);
  return following.follows();
}

TEST(Following, is_given_up_with_a_person_who_turns_away_or_not_at_all) {
  EXPECT_TRUE(follows_after(60.0, -0.5)) << "to the right";
  EXPECT_FALSE(follows_after(60.0, 0.5)) << "to the left";
  EXPECT_FALSE(follows_after(60.0, 0.0));
  EXPECT_TRUE(follows_after(60.0, 0.0, 0.3)) << "there is little to turn";
  EXPECT_TRUE(follows_after(10.0, 0.0)) << "one turn that was missed";
}

TEST(Following, begins_anew_with_another_trial) {
  Following following;
  for (double time = 0.0; time < 60.0; time += kStep)
    following.update(0.6, {0.0, 0.5}, time);
  EXPECT_FALSE(following.follows());
  following.forgive();
  EXPECT_TRUE(following.follows());
}

}  // namespace
}  // namespace navvi_feedback::lead
