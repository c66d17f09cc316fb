#include "smooth/turns.hpp"

#include <gtest/gtest.h>

namespace navvi_nav::smooth {
namespace {

constexpr double kTogether = 1.0;  // m

TEST(Turns, are_none_in_a_path_without_corners) {
  EXPECT_TRUE(turns_of({}, kTogether).empty());
  for (const Path& path : {Path{{1, 1}}, Path{{1, 1}, {2, 1}}, Path{{1, 1}, {2, 1}, {4, 1}}}) {
    const std::vector<Turn> turns = turns_of(path, kTogether);
    ASSERT_EQ(turns.size(), 1U);
    EXPECT_EQ(turns[0].at, path.size() - 1);
    EXPECT_EQ(turns[0].angle, 0.0);
  }
}

TEST(Turns, join_corners_that_are_close_and_leave_out_bends) {
  const Path path{{0, 0}, {4, 0}, {8, 1}, {8, 3}, {8.5, 3.5}, {12, 3.5}, {12, 4}};
  const std::vector<Turn> turns = turns_of(path, kTogether);
  ASSERT_EQ(turns.size(), 4U);
  EXPECT_EQ(turns[0].at, 2U);
  EXPECT_NEAR(turns[0].angle, -std::atan2(4, 1), 1e-12);
  EXPECT_EQ(turns[1].at, 3U);
  EXPECT_NEAR(turns[1].angle, kPi / 2, 1e-12);
  EXPECT_EQ(turns[2].at, 5U);  // the path's end is not joined with it
  EXPECT_NEAR(turns[2].angle, -kPi / 2, 1e-12);
  EXPECT_EQ(turns[3].at, 6U);
  EXPECT_EQ(turns_of(path, 0.0).size(), 6U);
}

TEST(Turns, make_a_swerve_that_comes_back_at_once_none_and_end_at_half_a_turn) {
  EXPECT_EQ(turns_of({{0, 0}, {4, 0}, {4.5, 0.5}, {9, 0.5}}, kTogether).size(), 1U);
  const std::vector<Turn> back =
      turns_of({{0, 0}, {4, 0}, {4.3, 0.5}, {4, 0.9}, {2, 0.5}, {0, -1}}, kTogether);
  EXPECT_NEAR(back[0].angle, -kPi, 0.1);
  EXPECT_GE(back[0].angle, -kPi);
}

}  // namespace
}  // namespace navvi_nav::smooth
