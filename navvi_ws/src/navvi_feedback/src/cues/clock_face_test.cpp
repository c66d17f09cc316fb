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
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  struct Row {
    const char* name;
    Rounding rounding;
    double hysteresis;                            // deg
    std::vector<std::pair<double, int>> at_hour;  // deg; 0: no hour
  };
  for (const Row& row : std::vector<Row>{
           {"and leaves it once it is clearly in another", Rounding::nearest, 5.0,
            {{14.0, 12}, {16.0, 12}, {19.9, 12}, {20.1, 1}, {14.0, 1}, {10.1, 1}, {9.9, 12}}},
           {"leaves a far one at once and survives the turn through six", Rounding::nearest, 5.0,
            {{0.0, 12}, {178.0, 6}, {-178.0, 6}, {-100.0, 9}}},
           {"but not across an unknown angle", Rounding::nearest, 5.0,
            {{14.0, 12}, {kUnknown, 0}, {16.0, 1}}},
           {"and floors without hysteresis exactly as printed", Rounding::floor, 0.0,
            {{29.0, 12}, {31.0, 1}, {29.0, 12}, {-1.0, 11}}}}) {
    SteadyHour hour(row.rounding, rad(row.hysteresis));
    for (const auto& [degrees, told] : row.at_hour)
      EXPECT_EQ(hour.update(rad(degrees)).value_or(0), told) << row.name << ", " << degrees;
  }
}

}  // namespace
}  // namespace navvi_feedback::cues
