#include "devices/latencies.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::devices {
namespace {

using namespace std::chrono_literals;

TEST(Latencies, of_nothing_are_nothing) {
  const Latencies::Figures none = Latencies().figures(Chain::motors);
  EXPECT_EQ(none.count, 0U);
  EXPECT_EQ(none.longest, 0.0);
  EXPECT_EQ(none.p99, 0.0);
}

TEST(Latencies, tell_the_middle_the_late_and_the_latest_of_each_chain) {
  Latencies latencies;
  for (int i = 0; i < 97; ++i) latencies.add(Chain::motors, Latencies::Clock::now() - 100ms);
  for (int i = 0; i < 3; ++i) latencies.add(Chain::motors, Latencies::Clock::now() - 500ms);
  latencies.add(Chain::words, Latencies::Clock::now() - 2s);
  const Latencies::Figures motors = latencies.figures(Chain::motors);
  EXPECT_EQ(motors.count, 100U);
  EXPECT_GE(motors.p50, 100.0);
  EXPECT_LT(motors.p50, 500.0);
  EXPECT_GE(motors.p99, 500.0);
  EXPECT_GE(motors.longest, motors.p99);
  EXPECT_GE(latencies.figures(Chain::words).longest, 2000.0);
  EXPECT_GE(latencies.figures(Chain::words).p50, 1000.0);
  EXPECT_EQ(latencies.figures(Chain::answer).count, 0U);
  latencies.clear();
  EXPECT_EQ(latencies.figures(Chain::motors).count, 0U);
}

}  // namespace
}  // namespace navvi_feedback::devices
