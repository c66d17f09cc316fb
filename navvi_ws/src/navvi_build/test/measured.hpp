#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace navvi_test {

using Clock = std::chrono::steady_clock;

/// A bound of doc/faults.md on the wall clock, at least doubled where more runs than there are processors. `./navvi test faults`
/// prints the time. \param what  has happened by now \param bound  ms
inline void expect_within(int bound, Clock::time_point since, const std::string& what) {
  const auto time = std::chrono::ceil<std::chrono::milliseconds>(Clock::now() - since).count();
  double load = 0.0;
  const double processors = std::thread::hardware_concurrency();
  const double crowd = ::getloadavg(&load, 1) == 1 ? load / processors : 0.0;
  testing::Test::RecordProperty(what, std::to_string(time) + " of " + std::to_string(bound) + " ms");
  EXPECT_LE(static_cast<double>(time), bound * (crowd > 1.0 ? std::max(2.0, crowd) : 1.0)) << what;
}

}  // namespace navvi_test
