#include "navvi_types/stall_guard.hpp"

#include <gtest/gtest.h>

namespace navvi_types {
namespace {

TEST(StallGuard, lets_a_program_catch_up_after_it_was_halted) {
  StallGuard guard;
  double time = 0.0;
  for (; time < 1.0; time += 0.02) EXPECT_FALSE(guard.catches_up(time)) << "an even beat";
  time += 3.0;
  EXPECT_TRUE(guard.catches_up(time));
  EXPECT_TRUE(guard.catches_up(time + 0.1));
  EXPECT_FALSE(guard.catches_up(time + 0.21));
}

TEST(StallGuard, does_not_silence_a_program_that_is_always_slow) {
  StallGuard guard;
  int beats = 0;
  int silent = 0;
  for (double time = 0.0; time < 60.0; time += 0.7, ++beats) silent += guard.catches_up(time);
  EXPECT_LE(silent, beats / 3 + 1);
}

TEST(StallGuard, takes_no_pause_for_a_halt_before_calls_are_expected) {
  StallGuard guard;
  EXPECT_FALSE(guard.catches_up(1.0));
  EXPECT_FALSE(guard.catches_up(9.0, 8.9)) << "a phase without calls";
}

}  // namespace
}  // namespace navvi_types
