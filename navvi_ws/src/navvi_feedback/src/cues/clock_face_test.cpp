#include "cues/clock_face.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_feedback::cues {
namespace {

constexpr double kPi = 3.14159265358979323846;

double rad(double degrees) { return degrees * kPi / 180.0; }

TEST(ClockHour, is_unknown_for_an_angle_that_is_no_number) {
  for (const Rounding rounding : {Rounding::nearest, Rounding::floor}) {
    EXPECT_FALSE(clock_hour(std::nan(""), rounding));
    EXPECT_FALSE(clock_hour(std::numeric_limits<double>::infinity(), rounding));
  }
}

TEST(ClockHour, rounds_to_the_nearest_hour) {
  const std::vector<std::pair<double, int>> table = {
      {0.0, 12},   {14.99, 12}, {15.01, 1},  {44.99, 1},   {45.01, 2},   {90.0, 3},
      {180.0, 6},  {-180.0, 6}, {-90.0, 9},  {270.0, 9},   {-15.01, 11}, {-14.99, 12},
      {-30.0, 11}, {359.9, 12}, {720.0, 12}, {-1e-18, 12}, {165.1, 6},   {-164.9, 7}};
  for (const auto& [degrees, hour] : table)
    EXPECT_EQ(clock_hour(rad(degrees), Rounding::nearest), hour) << degrees;
}

/// Its text says "round to the closest integer", its formula floors. The profile follows the
/// formula, so that a leg 0.1 degrees to the left is at 11 o'clock there.
TEST(ClockHour, floors_as_the_paper_prints_it) {
  const std::vector<std::pair<double, int>> table = {{0.0, 12},   {29.9, 12}, {30.1, 1},
                                                     {-0.1, 11},  {90.1, 3},  {179.9, 5},
                                                     {-179.9, 6}, {329.9, 10}};
  for (const auto& [degrees, hour] : table)
    EXPECT_EQ(clock_hour(rad(degrees), Rounding::floor), hour) << degrees;
}

TEST(SteadyHour, holds_the_hour_while_the_angle_trembles_on_the_border) {
  SteadyHour hour(Rounding::nearest, rad(5.0));
  EXPECT_EQ(hour.update(rad(14.0)), 12);
  EXPECT_EQ(hour.update(rad(16.0)), 12);
  EXPECT_EQ(hour.update(rad(19.9)), 12);
  EXPECT_EQ(hour.update(rad(20.1)), 1);
  EXPECT_EQ(hour.update(rad(14.0)), 1);
  EXPECT_EQ(hour.update(rad(10.1)), 1);
  EXPECT_EQ(hour.update(rad(9.9)), 12);
}

TEST(SteadyHour, leaves_a_far_hour_at_once_and_survives_the_turn_through_six) {
  SteadyHour hour(Rounding::nearest, rad(5.0));
  EXPECT_EQ(hour.update(rad(0.0)), 12);
  EXPECT_EQ(hour.update(rad(178.0)), 6);
  EXPECT_EQ(hour.update(rad(-178.0)), 6);
  EXPECT_EQ(hour.update(rad(-100.0)), 9);
}

TEST(SteadyHour, holds_nothing_across_an_unknown_angle) {
  SteadyHour hour(Rounding::nearest, rad(5.0));
  EXPECT_EQ(hour.update(rad(14.0)), 12);
  EXPECT_FALSE(hour.update(std::nan("")));
  EXPECT_EQ(hour.update(rad(16.0)), 1);
}

TEST(SteadyHour, floors_without_hysteresis_exactly_as_printed) {
  SteadyHour hour(Rounding::floor, 0.0);
  EXPECT_EQ(hour.update(rad(29.0)), 12);
  EXPECT_EQ(hour.update(rad(31.0)), 1);
  EXPECT_EQ(hour.update(rad(29.0)), 12);
  EXPECT_EQ(hour.update(rad(-1.0)), 11);
}

}  // namespace
}  // namespace navvi_feedback::cues
