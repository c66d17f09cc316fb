#include "drive/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace navvi_feedback::drive {
namespace {

constexpr double kStep = 0.02;  // s
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class DriveOf : public testing::Test {
 protected:
  std::optional<Velocity> hold(std::optional<Stick> stick, double seconds) {
    std::optional<Velocity> velocity;
    for (int i = 0; i < std::lround(seconds / kStep); ++i) velocity = drive_.update(stick, kStep);
    return velocity;
  }
  void arm() { hold(Stick{}, 0.4); }

  DriveConfig config_;
  Drive drive_{config_};
};

TEST_F(DriveOf, a_missing_stick_or_one_that_is_not_finite_gives_no_command) {
  EXPECT_FALSE(hold(std::nullopt, 1.0).has_value());
  arm();
  EXPECT_FALSE(drive_.update(Stick{kNan, 0.0}, kStep).has_value());
  EXPECT_FALSE(drive_.update(Stick{0.0, std::numeric_limits<double>::infinity()}, kStep));
  EXPECT_FALSE(drive_.armed());
}

TEST_F(DriveOf, J7_a_stick_that_is_held_when_it_appears_moves_nothing) {
  const auto velocity = hold(Stick{0.0, 1.0}, 5.0);
  ASSERT_TRUE(velocity);
  EXPECT_EQ(velocity->linear, 0.0);
  EXPECT_FALSE(drive_.armed());
}

TEST_F(DriveOf, J7_a_stick_arms_after_three_hundred_milliseconds_of_neutral) {
  hold(Stick{}, 0.28);
  EXPECT_FALSE(drive_.armed());
  hold(Stick{}, 0.04);
  EXPECT_TRUE(drive_.armed());
}

TEST_F(DriveOf, J3_a_returning_stick_that_is_held_moves_nothing) {
  arm();
  hold(Stick{0.0, 1.0}, 2.0);
  hold(std::nullopt, kStep);
  EXPECT_EQ(hold(Stick{0.0, 1.0}, 2.0)->linear, 0.0);
}

TEST_F(DriveOf, a_stick_that_comes_back_arms_anew_and_begins_from_a_standstill) {
  arm();
  hold(Stick{1.0, 1.0}, 2.0);
  hold(std::nullopt, kStep);
  hold(Stick{}, 0.28);
  EXPECT_FALSE(drive_.armed());
  hold(Stick{}, 0.04);
  EXPECT_TRUE(drive_.armed());
  const Velocity velocity = *hold(Stick{1.0, 1.0}, kStep);
  EXPECT_NEAR(velocity.linear, config_.acceleration * kStep, 1e-9);
  EXPECT_NEAR(velocity.angular, config_.turn_acceleration * kStep, 1e-9);
}

TEST_F(DriveOf, J7_drift_within_the_dead_zone_counts_as_neutral) {
  hold(Stick{0.05, -0.05}, 0.4);
  EXPECT_TRUE(drive_.armed());
  const auto velocity = hold(Stick{0.05, -0.05}, 1.0);
  EXPECT_EQ(velocity->linear, 0.0);
  EXPECT_EQ(velocity->angular, 0.0);
}

TEST_F(DriveOf, full_stick_gives_the_maximums_with_their_signs) {
  arm();
  EXPECT_NEAR(hold(Stick{0.0, 1.0}, 3.0)->linear, config_.max_forward, 1e-9);
  EXPECT_NEAR(hold(Stick{0.0, -1.0}, 3.0)->linear, -config_.max_reverse, 1e-9);
  EXPECT_NEAR(hold(Stick{1.0, 0.0}, 3.0)->angular, config_.max_turn, 1e-9);
  EXPECT_NEAR(hold(Stick{-1.0, 0.0}, 3.0)->angular, -config_.max_turn, 1e-9);
}

TEST_F(DriveOf, the_curve_starts_at_zero_only_rises_and_ends_at_one) {
  EXPECT_NEAR(drive_.shaped({7.0, -9.0}).x, 1.0, 1e-12);
  EXPECT_NEAR(drive_.shaped({7.0, -9.0}).y, -1.0, 1e-12);
  double last = 0.0;
  for (double y = 0.0; y <= 1.0; y += 0.001) {
    const double shaped = drive_.shaped({0.0, y}).y;
    EXPECT_GE(shaped, last);
    EXPECT_LT(shaped - last, 0.003);
    EXPECT_EQ(drive_.shaped({0.0, -y}).y, -shaped);
    last = shaped;
  }
}

TEST_F(DriveOf, never_changes_faster_than_its_limits) {
  arm();
  Velocity last;
  const double hardest = std::max(config_.acceleration, config_.deceleration) * kStep + 1e-12;
  for (int i = 0; i < 2000; ++i) {
    const Stick stick{std::sin(0.7 * i), i % 90 < 45 ? 1.0 : -1.0};
    const Velocity velocity = *drive_.update(stick, kStep);
    EXPECT_LE(std::abs(velocity.linear - last.linear), hardest);
    EXPECT_LE(std::abs(velocity.angular - last.angular), config_.turn_acceleration * kStep + 1e-12);
    EXPECT_LE(std::abs(velocity.linear), config_.max_forward);
    last = velocity;
  }
}

TEST_F(DriveOf, slows_down_by_the_brakes_also_where_the_stick_is_thrown_over) {
  for (const double to : {0.0, 0.2, -1.0}) {
    arm();
    hold(Stick{1.0, 1.0}, 3.0);
    EXPECT_NEAR(hold(Stick{0.0, to}, kStep)->linear,
                config_.max_forward - config_.deceleration * kStep, 1e-9);
    const Velocity released = *hold(Stick{}, 1.0);
    EXPECT_EQ(released.linear, 0.0) << "a full stop";
    EXPECT_EQ(released.angular, 0.0);
    EXPECT_NEAR(hold(Stick{0.0, -1.0}, kStep)->linear, -config_.acceleration * kStep, 1e-9);
    hold(Stick{0.0, -1.0}, 3.0);
    EXPECT_NEAR(hold(Stick{0.0, -to}, kStep)->linear,
                config_.deceleration * kStep - config_.max_reverse, 1e-9);
  }
}

TEST(Fastest, leaves_the_way_that_a_robot_needs_which_brakes_no_harder_than_it_must) {
  const auto way = [](double speed) { return speed * speed / (2.0 * navvi_types::kBrakes); };
  EXPECT_DOUBLE_EQ(stopping_distance(-0.9), -way(0.9));
  for (const double round_trip : {0.1, 0.5, 2.0}) {
    for (const double gap : {0.3, 0.6, 1.0}) {
      NearThing ahead;
      ahead.gap = gap;
      ahead.nearest = {0.35 + gap, 0.0};
      const double speed = fastest(round_trip, {0.9, 0.0}, {ahead});
      EXPECT_NEAR(speed * (round_trip + 0.6) + way(speed), gap - 0.1, 1e-9) << round_trip;
    }
  }
}

}  // namespace
}  // namespace navvi_feedback::drive
