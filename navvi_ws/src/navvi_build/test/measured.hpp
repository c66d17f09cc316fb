#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

namespace navvi_test {

using Clock = std::chrono::steady_clock;

/// Threads that run or wait for a processor, but this one, for each processor: now, not in the last
/// minute as the load has it.
inline double crowd() {
  constexpr int kLooks = 25;
  double running = 0.0;
  for (int look = 0; look < kLooks; ++look) {
    std::ifstream file("/proc/loadavg");  // such as 2.11 2.08 2.01 3/110 3396
    std::string word;
    for (int column = 0; column < 4; ++column) file >> word;
    running += std::atof(word.c_str()) - 1.0;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return running / kLooks / std::thread::hardware_concurrency();
}

/// A bound of doc/faults.md on the wall clock, doubled where more runs than there are processors.
/// `./navvi test faults` prints the time. \param what  has happened by now \param bound  ms
inline void expect_within(int bound, Clock::time_point since, const std::string& what) {
  const auto time = std::chrono::ceil<std::chrono::milliseconds>(Clock::now() - since).count();
  testing::Test::RecordProperty(what, std::to_string(time) + " of " + std::to_string(bound) + " ms");
  if (time <= bound) return;
  const double beside = crowd();
  EXPECT_TRUE(beside > 1.0 && time <= 2 * bound)
      << what << " after " << time << " of " << bound << " ms, beside " << beside << " a processor"
      << (beside > 4.0 ? ": too busy to judge" : "");
}

}  // namespace navvi_test
