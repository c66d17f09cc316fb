#include "drive/stick_age.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_feedback::drive {
namespace {

using Late = StickAge::Late;

TEST(StickAge, knows_of_no_delay_before_the_first_message_and_after_the_last) {
  StickAge age;
  EXPECT_EQ(age.late(1.0), Late::no);
  age.add(3.0, 1.0);
  EXPECT_EQ(age.late(1.2), Late::too_late);
  EXPECT_EQ(age.late(1.3), Late::no) << "it is lost, which is told";
}

TEST(StickAge, C6_slows_above_300_ms_and_stops_above_1_s_in_either_direction) {
  StickAge age;
  const auto of = [&](double seconds) {
    age.add(seconds, 1.0);
    return age.late(1.0);
  };
  EXPECT_EQ(of(0.29), Late::no);
  EXPECT_EQ(of(0.31), Late::slow);
  EXPECT_EQ(of(0.99), Late::slow);
  EXPECT_EQ(of(1.01), Late::too_late);
  EXPECT_EQ(of(-0.99), Late::no);
  EXPECT_EQ(of(-1.01), Late::too_late);
  EXPECT_EQ(of(std::numeric_limits<double>::quiet_NaN()), Late::too_late);
}

}  // namespace
}  // namespace navvi_feedback::drive
