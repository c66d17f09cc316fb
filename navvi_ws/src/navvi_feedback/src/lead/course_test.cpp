#include "lead/course.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::lead {
namespace {

constexpr double kFull = 0.9;  // m/s

std::optional<Course> shown(std::optional<double> off, const std::vector<NearThing>& nearby = {},
                            double speed = 0.0, double beside = kBesideBySound) {
  Pilot pilot;
  const std::optional<Way> way = off ? std::optional(Way{*off}) : std::nullopt;
  (void)pilot.update(way, {}, beside, speed, kFull, 9.0);
  return pilot.update(way, nearby, beside, speed, kFull, 10.0);
}

NearThing thing(double gap, double x, double y, bool moving) {
  return {navvi_types::ThingClass::forklift, 1, gap, {x, y}, moving};
}

TEST(Pilot, shows_full_speed_straight_on_less_in_a_bend_and_none_to_turn_on_the_spot) {
  EXPECT_DOUBLE_EQ(shown(0.0).value().speed, 1.0);
  EXPECT_NEAR(shown(kOnTheSpot / 2.0).value().speed, 0.75, 1e-9);
  EXPECT_DOUBLE_EQ(shown(-1.0).value().speed, 0.0);
  EXPECT_DOUBLE_EQ(shown(-1.0).value().turn, -1.0);
  EXPECT_FALSE(shown(std::nullopt));
}

TEST(Pilot, slows_down_before_what_is_ahead_and_stands_before_what_moves) {
  EXPECT_NEAR(shown(0.0, {thing(0.7, 1.0, 0.0, false)}).value().speed, 0.18 / kFull, 1e-9)
      << "a person goes on for a while";
  EXPECT_DOUBLE_EQ(shown(0.0, {thing(0.7, 1.0, 0.8, false)}).value().speed, 1.0) << "beside";
  EXPECT_DOUBLE_EQ(shown(0.0, {thing(0.7, -1.0, 0.0, true)}).value().speed, 1.0) << "behind";
  EXPECT_FALSE(shown(0.0, {thing(0.5, 0.9, 0.0, true)}));
  EXPECT_FALSE(shown(0.0, {thing(1.0, 1.4, 0.0, true)}, 0.8)) << "a person takes time to stop";
  EXPECT_TRUE(shown(0.5, {thing(0.5, 0.9, 0.0, true)})) << "there is something to turn";
}

TEST(Pilot, slows_down_before_a_sharp_corner_and_not_before_the_goal) {
  const auto before = [](double corner, double turn) {
    return Pilot().update(Way{0.0, corner, turn}, {}, kBesideBySound, 0.0, kFull, 1.0)->speed;
  };
  EXPECT_LT(before(0.5, 1.6), 0.4);
  EXPECT_DOUBLE_EQ(before(0.5, -1.6), before(0.5, 1.6));
  EXPECT_GT(before(0.5, 0.5), before(0.5, 1.6) + 0.2);
  EXPECT_DOUBLE_EQ(before(3.0, 1.6), 1.0);
  EXPECT_DOUBLE_EQ(before(0.2, 0.0), 1.0) << "the goal";
}

TEST(Pilot, shows_a_turn_past_what_is_all_but_touched_on_the_spot) {
  const std::vector<NearThing> shelf = {thing(0.2, 0.5, 0.3, false)};
  EXPECT_DOUBLE_EQ(shown(0.5, shelf).value().speed, 0.0);
  EXPECT_GT(shown(0.2, shelf).value().speed, 0.0);
  EXPECT_GT(shown(0.5, {thing(0.2, -0.1, 0.5, false)}).value().speed, 0.0) << "behind";
}

/// A robot that turns as late and as quickly as a person steers who is shown the way.
/// \return rad, by which it turns too far
double overshoot(double delay, double gain, double beat = 0.02) {
  Pilot pilot;
  std::deque<double> pipe(static_cast<std::size_t>(delay / beat), 0.0);
  double off = 0.7, least = off;
  for (double time = 0.0; time < 20.0; time += beat) {
    const auto course = pilot.update(Way{off}, {}, kBesideBySound, 0.0, kFull, time);
    pipe.push_back(course.value().turn);
    off -= beat * gain * pipe.front();
    pipe.pop_front();
    least = std::min(least, off);
  }
  EXPECT_LT(std::abs(off), 0.01);
  return -least;
}

TEST(Pilot, leads_the_able_and_the_slow_round_a_corner_without_turning_too_far) {
  EXPECT_LT(overshoot(0.3, 2.0), 0.01);
  EXPECT_LT(overshoot(0.6, 1.0), 0.01);
  EXPECT_LT(overshoot(1.2, 0.5), 0.05);
  EXPECT_LT(overshoot(1.0, 1.0), 0.2) << "quicker than fits the delay";
  EXPECT_NEAR(overshoot(1.0, 1.0, 0.01), overshoot(1.0, 1.0), 0.02) << "beats of 10 ms";
}

/// What is shown of an angle that has been shown for so long.
Course held(double off, double seconds, const std::vector<NearThing>& nearby = {}) {
  Pilot pilot;
  Course last;
  for (double time = 0.0; time < seconds; time += 0.02)
    last = pilot.update(Way{off}, nearby, kBesideBySound, 0.0, kFull, time).value_or(Course{});
  return last;
}

TEST(Pilot, turns_on_the_spot_a_robot_that_does_not_turn_yet) {
  EXPECT_DOUBLE_EQ(held(1.2, 3.0).speed, 0.0);
  EXPECT_GT(held(1.2, 3.0).turn, 0.5);
  EXPECT_DOUBLE_EQ(held(0.5, 3.0, {thing(0.2, 0.5, 0.3, false)}).speed, 0.0);
}

TEST(Pilot, does_not_turn_back_half_way_round) {
  Pilot pilot;
  for (double time = 0.0; time < 0.6; time += 0.02)
    EXPECT_GT(pilot.update(Way{3.1}, {}, kBesideBySound, 0.0, kFull, time)->turn, 0.0);
  EXPECT_GT(pilot.update(Way{-3.1}, {}, kBesideBySound, 0.0, kFull, 0.6)->turn, 0.0);
}

TEST(Pilot, shows_without_a_break_what_little_is_to_turn_before_the_way_is_free) {
  Pilot pilot;
  for (double time = 0.0; time < 1.5; time += 0.02)
    EXPECT_TRUE(pilot.update(Way{0.13}, {thing(0.5, 0.9, 0.0, true)}, kBesideBySound, 0.0, kFull,
                             time));
}

TEST(Pilot, slows_the_hand_down_before_a_wall_beside_the_lane_that_the_nose_points_at) {
  const std::vector<NearThing> ahead = {thing(0.5, 0.6, 0.7, false)};
  const double way = 0.5 * std::hypot(0.6, 0.7) / 0.6;
  const double speed = (way - 0.25) / 1.7 / kFull;
  EXPECT_NEAR(shown(0.0, ahead, 0.7, kBesideByHand).value().speed, speed, 1e-9);
  EXPECT_DOUBLE_EQ(shown(0.0, ahead, 0.7).value().speed, 1.0) << "a sound is followed at once";
  const std::vector<NearThing> along = {thing(0.5, 0.1, 0.8, false)};
  EXPECT_DOUBLE_EQ(shown(0.0, along, 0.7, kBesideByHand).value().speed, 1.0);
}

TEST(Pilot, creeps_past_what_waits_beside_the_lane_after_two_seconds) {
  Pilot pilot;
  const std::vector<NearThing> waits = {thing(0.3, 0.5, 0.5, true)};
  (void)pilot.update(Way{}, {}, kBesideBySound, 0.0, kFull, 9.9);
  EXPECT_FALSE(pilot.update(Way{}, waits, kBesideBySound, 0.0, kFull, 11.0));
  const auto course = pilot.update(Way{}, waits, kBesideBySound, 0.0, kFull, 12.5);
  ASSERT_TRUE(course);
  EXPECT_GT(course->speed, 0.0);
  EXPECT_LT(course->speed, 0.2);
}

TEST(Pilot, takes_what_nobody_notices_for_standing) {
  Pilot pilot;
  const std::vector<NearThing> waits = {thing(0.64, 0.9, 0.0, true)};
  EXPECT_FALSE(pilot.update(Way{}, waits, kBesideByHand, 0.0, kFull, 100.0)) << "0.04 m/s";
  EXPECT_TRUE(pilot.update(Way{}, waits, kBesideByHand, 0.0, kFull, 109.0))
      << "it does not go away";
}

TEST(Pilot, creeps_towards_what_does_not_go_away_and_stands_before_it) {
  for (const double gap : {0.5, 0.3}) {
    Pilot pilot;
    const std::vector<NearThing> waits = {thing(gap, 0.4 + gap, 0.0, true)};
    EXPECT_FALSE(pilot.update(Way{}, waits, kBesideBySound, 0.0, kFull, 100.0));
    EXPECT_FALSE(pilot.update(Way{}, waits, kBesideBySound, 0.0, kFull, 107.9));
    const auto course = pilot.update(Way{}, waits, kBesideBySound, 0.0, kFull, 108.1);
    EXPECT_EQ(course.has_value(), gap > 0.4) << gap;
    EXPECT_LT(course.value_or(Course{}).speed, 0.2);
    EXPECT_DOUBLE_EQ(pilot.update(Way{}, {}, kBesideBySound, 0.0, kFull, 121.0).value().speed, 1.0);
  }
}

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
