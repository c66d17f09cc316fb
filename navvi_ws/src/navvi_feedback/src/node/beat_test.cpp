#include "node/beat.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::node {
namespace {

/// Lets `beat` pass `count` times, `period` s apart. \returns how often it became late
int pass(Beat& beat, double& time, int count, double period) {
  int told = 0;
  for (int i = 0; i < count; ++i) told += beat.becomes_late(time += period);
  return told;
}

TEST(Beat, of_a_machine_with_time_is_never_late) {
  Beat beat(0.1);
  double time = 100.0;
  EXPECT_EQ(pass(beat, time, 10000, 0.02), 0);
  EXPECT_NEAR(beat.longest(), 0.02, 1e-9);
}

TEST(Beat, that_stops_once_in_a_while_is_not_late) {
  Beat beat(0.1);
  double time = 100.0;
  int told = 0;
  for (int i = 0; i < 100; ++i) told += pass(beat, time, 200, 0.02) + pass(beat, time, 1, 2.0);
  EXPECT_EQ(told, 0) << "a program that is halted is no busy machine";
  EXPECT_NEAR(beat.longest(), 2.0, 1e-9);
}

TEST(Beat, of_a_machine_without_time_is_late_once) {
  Beat beat(0.1);
  double time = 100.0;
  pass(beat, time, 100, 0.02);
  EXPECT_EQ(pass(beat, time, 4, 0.15), 0);
  EXPECT_EQ(pass(beat, time, 1000, 0.15), 1);
  EXPECT_TRUE(beat.was_late());
}

}  // namespace
}  // namespace navvi_feedback::node
