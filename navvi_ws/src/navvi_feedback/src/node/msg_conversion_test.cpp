#include "navvi_feedback/node/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_feedback::node {
namespace {

TEST(FromMsg, a_joy_needs_two_axes_in_range) {
  sensor_msgs::Joy msg;
  EXPECT_FALSE(from_msg(msg).has_value());
  msg.axes = {0.5F, -1.0F};
  EXPECT_TRUE(from_msg(msg).has_value());
  for (const float bad : {std::nanf(""), 1.5F, -2.0F, std::numeric_limits<float>::infinity()}) {
    msg.axes[1] = bad;
    EXPECT_FALSE(from_msg(msg).has_value());
  }
}

TEST(Joy, survives_the_round_trip) {
  drive::InputState input;
  input.live = true;
  input.axes = {0.5, -0.25, 0.0};
  input.buttons = {true, false, true};
  const auto back = from_msg(to_msg(input, ros::Time(3.0)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->axes, input.axes);
  EXPECT_EQ(back->buttons, input.buttons);
}

TEST(ToMsg, rumble_names_both_motors_also_when_they_are_off) {
  const auto msg = feedback_msg({0.0, 0.5});
  ASSERT_EQ(msg.array.size(), 2u);
  EXPECT_EQ(msg.array[0].type, sensor_msgs::JoyFeedback::TYPE_RUMBLE);
  EXPECT_EQ(msg.array[0].id, 0);
  EXPECT_EQ(msg.array[0].intensity, 0.0F);
  EXPECT_EQ(msg.array[1].id, 1);
  EXPECT_EQ(msg.array[1].intensity, 0.5F);
  EXPECT_EQ(feedback_msg({0.25, 0.5}, "ds4_driver").array[0].intensity, 0.5F);
  EXPECT_EQ(feedback_msg({0.25, 0.5}, "ds4_driver").array[1].intensity, 0.25F);
}

TEST(LastWords, tell_the_end_of_a_trial_unless_the_arrival_does) {
  navvi_msgs::TrialEvent msg;
  msg.type = "TRIAL_END";
  msg.fields = "path_length=3.2;result=timeout;reason=limit";
  EXPECT_EQ(last_words(msg), Content(CueKind::trial_ends, About::time_up));
  msg.fields = "result=invalid;reason=disk_full";
  EXPECT_EQ(last_words(msg), CueKind::trial_disk_full);
  msg.fields = "result=aborted;reason=guidance_lost";
  EXPECT_EQ(last_words(msg), Content(CueKind::trial_ends, About::over));
  msg.fields = "result=reached;reason=goal_reached";
  EXPECT_FALSE(last_words(msg));
  msg.fields = "result=refused;reason=not_seen";
  EXPECT_FALSE(last_words(msg)) << "why, is told by itself";
  msg.type = "GOAL_SET";
  msg.fields = "result=timeout";
  EXPECT_FALSE(last_words(msg));
}

}  // namespace
}  // namespace navvi_feedback::node
