#include "trial/readiness.hpp"

#include <gtest/gtest.h>

namespace navvi_study::trial {
namespace {

using Words = std::vector<std::string>;

Guidance guidance(Guidance::State state) {
  Guidance report;
  report.state = state;
  return report;
}

TEST(Readiness, of_nothing_misses_everything) {
  EXPECT_EQ(Readiness({}).missing(0.0, false),
            (Words{"the clock", "odometry", "guidance", "a report of feedback_node"}));
}

TEST(Readiness, A1_waits_for_a_guide_that_never_starts) {
  Readiness ready({});
  ready.saw_odometry(10.0);
  ready.saw(guidance(Guidance::State::no_goal), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{"a report of feedback_node"});
  ready.saw({0, "audio", DeviceState::missing}, 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{});
}

TEST(Readiness, needs_messages_that_still_flow_and_a_map) {
  Readiness ready({});
  ready.saw_odometry(10.0);
  ready.saw({0, "audio", DeviceState::works}, 10.0);
  ready.saw(guidance(Guidance::State::no_map), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{"a map and a pose in guidance"});
  ready.saw(guidance(Guidance::State::no_goal), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{});
  EXPECT_EQ(ready.missing(12.0, true), (Words{"odometry", "guidance"}));
  EXPECT_EQ(ready.silence(12.0), 2.0);
}

TEST(Readiness, says_of_each_device_what_was_last_reported) {
  Readiness ready({});
  EXPECT_EQ(ready.state_of("audio"), "unknown");
  ready.saw({0, "audio", DeviceState::works}, 0.0);
  EXPECT_EQ(ready.state_of("audio"), "works");
  ready.saw({0, "audio", DeviceState::missing}, 0.0);
  EXPECT_EQ(ready.state_of("audio"), "missing");
  ready.saw({0, "audio", DeviceState::off}, 0.0);
  EXPECT_EQ(ready.state_of("audio"), "off");
}

TEST(Readiness, misses_the_feedback_only_once_it_was_there) {
  Readiness ready({});
  EXPECT_EQ(ready.feedback_silence(100.0), 0.0);
  ready.saw({0, "audio", DeviceState::works}, 100.0);
  EXPECT_EQ(ready.feedback_silence(103.0), 3.0);
}

TEST(Readiness, needs_the_devices_of_the_condition) {
  Readiness ready({"speech", "rumble"});
  ready.saw_odometry(0.0);
  ready.saw(guidance(Guidance::State::no_goal), 0.0);
  ready.saw({0, "audio", DeviceState::works}, 0.0);
  ready.saw({0, "speech", DeviceState::works}, 0.0);
  ready.saw({0, "pad", DeviceState::off}, 0.0);
  EXPECT_EQ(ready.missing(0.1, true), Words{"a working pad device"});
}

}  // namespace
}  // namespace navvi_study::trial
