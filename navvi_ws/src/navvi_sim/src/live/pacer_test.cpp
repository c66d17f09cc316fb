#include "live/pacer.hpp"

#include <gtest/gtest.h>

namespace navvi_sim::live {
namespace {

TEST(Pacer, gives_no_step_at_first_and_keeps_pace_after) {
  Pacer pacer(0.01, 1.0, 10);
  EXPECT_EQ(pacer.due(100.0), 0);
  int steps = 0;
  for (int i = 1; i <= 1000; ++i) steps += pacer.due(100.0 + 0.003 * i);
  EXPECT_EQ(steps, 300);
  EXPECT_EQ(pacer.dropped(), 0);
}

TEST(Pacer, runs_faster_than_the_wall_clock_if_asked) {
  Pacer pacer(0.01, 4.0, 100);
  EXPECT_EQ(pacer.due(0.0), 0);
  EXPECT_EQ(pacer.due(0.1), 40);
}

TEST(Pacer, S4_lets_go_of_what_it_cannot_catch_up) {
  Pacer pacer(0.01, 1.0, 5);
  EXPECT_EQ(pacer.due(0.0), 0);
  EXPECT_EQ(pacer.due(1.0), 5);
  EXPECT_EQ(pacer.dropped(), 95);
  EXPECT_EQ(pacer.due(1.01), 1);
}

TEST(Pacer, S7_a_pause_of_ten_minutes_is_not_made_up_for) {
  Pacer pacer(0.01, 1.0, 10);
  EXPECT_EQ(pacer.due(0.0), 0);
  EXPECT_EQ(pacer.due(600.0), 10);
  EXPECT_EQ(pacer.dropped(), 59990);
  int steps = 0;
  for (int i = 1; i <= 100; ++i) steps += pacer.due(600.0 + 0.01 * i);
  EXPECT_EQ(steps, 100);
}

}  // namespace
}  // namespace navvi_sim::live
