#include "navvi_people/people/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kStep = 0.02;  // s

TEST(Tracking, follows_each_part_of_a_display_after_its_delay) {
  Tracking tracking({0.4, 0.8, 0.2, 0.3, 0.0}, false, 1);
  tracking.show(Aim{0.5, 1.0}, 1.0);
  EXPECT_FALSE(tracking.update(1.39, kStep, 0.0));
  ASSERT_TRUE(tracking.update(1.41, kStep, 0.0));
  EXPECT_DOUBLE_EQ(tracking.update(1.5, kStep, 0.0)->turn, 0.5);
  EXPECT_DOUBLE_EQ(tracking.update(1.5, kStep, 0.0)->speed, 0.0) << "more speed comes later";
  EXPECT_DOUBLE_EQ(tracking.update(1.9, kStep, 0.0)->speed, 1.0);
  tracking.show(Aim{0.5, 0.2}, 2.0);
  EXPECT_DOUBLE_EQ(tracking.update(2.25, kStep, 0.0)->speed, 0.2) << "less is followed sooner";
  tracking.show(std::nullopt, 3.0);
  EXPECT_TRUE(tracking.update(3.15, kStep, 0.0));
  EXPECT_TRUE(tracking.update(3.25, kStep, 0.148)) << "words take attention";
  EXPECT_FALSE(tracking.update(3.4, kStep, 0.0));
  EXPECT_FALSE(tracking.since());
}

TEST(Tracking, has_the_less_gain_the_slower_it_is) {
  EXPECT_DOUBLE_EQ(Tracking({0.3, 0.3, 0.3, 0.0, 0.0}, false, 1).gain(), 2.0);
  EXPECT_DOUBLE_EQ(Tracking({0.8, 0.8, 0.8, 0.0, 0.0}, false, 1).gain(), 0.75);
}

TEST(Tracking, errs_in_proportion_to_what_is_shown) {
  const auto spread = [](double turn) {
    Tracking tracking({0.1, 0.1, 0.1, 0.3, 0.0}, true, 5);
    tracking.show(Aim{turn, 1.0}, 0.0);
    double squares = 0.0;
    for (int i = 10; i < 5000; ++i)
      squares += std::pow(tracking.update(i * kStep, kStep, 0.0)->turn - turn, 2);
    return std::sqrt(squares / 4990.0);
  };
  EXPECT_NEAR(spread(0.0), 0.035, 0.006);
  EXPECT_NEAR(spread(0.7), 0.3 * 0.7 + 0.035, 0.04);
}

TEST(Pulses, are_read_by_side_force_and_pace) {
  Pulses pulses;
  const auto pulse = [&](double time, Felt felt) {
    pulses.feel(felt, time);
    const auto aim = pulses.update(time + 0.01);
    pulses.feel({}, time + 0.15);
    return aim.value();
  };
  EXPECT_FALSE(pulses.update(0.0));
  EXPECT_LT(pulse(1.0, {0.35, 0.35}).speed, 0.3) << "the first is taken for slow";
  EXPECT_DOUBLE_EQ(pulse(1.3, {0.35, 0.35}).speed, 1.0);
  EXPECT_DOUBLE_EQ(pulse(1.6, {0.35, 0.35}).turn, 0.0);
  const double little = pulse(1.9, {0.0, 0.35}).turn;
  EXPECT_GT(little, 0.0);
  EXPECT_GT(pulse(2.2, {0.0, 0.7}).turn, little);
  EXPECT_LT(pulse(2.7, {0.7, 0.0}).turn, 0.0);
  EXPECT_DOUBLE_EQ(pulses.update(2.9)->speed, 0.5);
  EXPECT_FALSE(pulses.update(3.6)) << "no further pulse: stand";
}

TEST(Pulses, without_a_break_ask_for_a_turn_on_the_spot_and_two_hard_motors_for_nothing) {
  Pulses pulses;
  pulses.feel({0.7, 0.0}, 1.0);
  EXPECT_LT(pulses.update(1.4)->turn, -0.8);
  EXPECT_DOUBLE_EQ(pulses.update(1.4)->speed, 0.0);
  pulses.feel({}, 2.0);
  pulses.feel({1.0, 1.0}, 2.5);
  EXPECT_FALSE(pulses.update(2.6));
}

}  // namespace
}  // namespace navvi_people::people
