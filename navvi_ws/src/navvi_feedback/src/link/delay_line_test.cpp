#include "link/delay_line.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace navvi_feedback::link {
namespace {

constexpr double kStep = 0.02;  // s

/// s, of each value sent every 20 ms for so long, from sending to arrival.
std::vector<double> ages(const LinkConfig& config, double seconds) {
  DelayLine<int> line(config, 1);
  std::vector<double> found;
  int next = 0;
  for (int i = 0; i * kStep < seconds; ++i) {
    line.send(i, i * kStep);
    line.receive(i * kStep, [&](int value, double sent) {
      EXPECT_EQ(value, next++) << "in order, none is lost";
      found.push_back(i * kStep - sent);
    });
  }
  return found;
}

double longest(const std::vector<double>& ages) {
  return *std::max_element(ages.begin(), ages.end());
}

TEST(DelayLine, hands_over_after_the_delay) {
  LinkConfig config;
  config.delay = 0.3;
  const auto found = ages(config, 10.0);
  EXPECT_NEAR(found.front(), 0.3, kStep);
  EXPECT_NEAR(longest(found), 0.3, 1.1 * kStep);
}

TEST(DelayLine, a_lost_packet_holds_up_those_after_it) {
  LinkConfig config;
  config.delay = 0.05;
  config.loss = 0.01;
  const auto found = ages(config, 60.0);
  EXPECT_GT(longest(found), 0.2);
  const auto late = std::count_if(found.begin(), found.end(), [](double age) { return age > 0.1; });
  const auto lost = static_cast<double>(found.size()) * config.loss;
  EXPECT_GT(static_cast<double>(late), 3.0 * lost) << "each holds up some that follow";
}

TEST(DelayLine, jitter_comes_on_top_of_the_delay) {
  LinkConfig config;
  config.delay = 0.1;
  config.jitter = 0.02;
  const auto found = ages(config, 60.0);
  EXPECT_GE(*std::min_element(found.begin(), found.end()), 0.1 - 1e-9);
  EXPECT_GT(longest(found), 0.14);
}

TEST(DelayLine, an_outage_comes_once_a_minute_and_delivers_all_at_its_end) {
  LinkConfig config;
  config.outage = 5.0;
  const auto found = ages(config, 180.0);
  EXPECT_NEAR(longest(found), 5.0, 0.1);
  const auto held = std::count_if(found.begin(), found.end(), [](double age) { return age > kStep; });
  EXPECT_NEAR(static_cast<double>(held) * kStep, 15.0, 5.1) << "three outages, or two";
}

}  // namespace
}  // namespace navvi_feedback::link
