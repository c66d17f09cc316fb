#include "link/delay_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace navvi_feedback::link {
namespace {

constexpr double kStep = 0.02;  // s

/// s, of each value sent every 20 ms for so long, from sending to arrival.
std::vector<double> ages(const LinkConfig& config, double seconds) {
  DelayLine<int> line(config, 1, 1);
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

TEST(DelayLine, a_lost_packet_holds_up_no_other_stream) {
  LinkConfig config;
  config.delay = 0.05;
  config.loss = 0.02;
  DelayLine<int> line(config, 1, 8);
  double last = 0.0, longest_silence = 0.0;
  std::vector<int> next(8, 0);
  for (int i = 0; i < 3000; ++i) {
    const double time = i * kStep;
    for (int stream = 0; stream < 8; ++stream) line.send(8 * i + stream, time, stream);
    line.receive(time, [&](int value, double) {
      EXPECT_EQ(value / 8, next[value % 8]++) << "in order in each stream";
      longest_silence = std::max(longest_silence, time - last);
      last = time;
    });
  }
  EXPECT_LT(longest_silence, 0.1);
}

TEST(DelayLine, values_of_packets_of_their_own_wait_for_none_and_overtake) {
  LinkConfig config;
  config.delay = 0.1;
  config.jitter = 0.05;
  config.loss = 0.1;
  config.outage = 3.0;
  DelayLine<int> line(config, 1, 0);
  int last = -1, came = 0;
  double at = 0.0, silence = 0.0;
  for (int i = 0; i < 6000; ++i) {
    line.send(i, i * kStep);
    line.receive(i * kStep, [&](int value, double sent) {
      EXPECT_GT(value, last) << "none that is older than what was received";
      EXPECT_LT(i * kStep - sent, 0.6);
      if (i * kStep - at < 2.5) silence = std::max(silence, i * kStep - at);
      last = value;
      at = i * kStep;
      ++came;
    });
  }
  EXPECT_LT(silence, 0.25);
  EXPECT_GT(came, 3000);
  EXPECT_LT(came, 5500);
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

TEST(DelayLine, a_narrow_link_hands_over_the_newest_of_each_stream) {
  LinkConfig config;
  config.bandwidth = 15.0;  // of the 60 kB/s that are sent
  DelayLine<int> line(config, 1, 4);
  std::vector<int> came(4, 0), last(4, -1);
  double oldest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double time = i * kStep;
    for (int stream = 0; stream < 4; ++stream) line.send(4 * i + stream, time, stream);
    line.receive(time, [&](int value, double sent) {
      const int stream = value % 4;
      EXPECT_GT(value, last[stream]) << "in order";
      EXPECT_EQ(value / 4, std::lround(sent / kStep)) << "with the time at which it was sent";
      last[stream] = value;
      ++came[stream];
      oldest = std::max(oldest, time - sent);
    });
  }
  EXPECT_LT(oldest, 0.1 + kStep) << "a message of each stream is before it at most";
  for (const int count : came) EXPECT_NEAR(count, 60.0 * 15.0 / (4 * 0.3), 30.0);
}

}  // namespace
}  // namespace navvi_feedback::link
