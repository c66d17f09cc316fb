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
  EXPECT_EQ(Readiness({}).missing(0.0, false), (Words{"the clock (/clock)", "odometry (/odom)",
                                                      "guidance of nav_node (/navvi/guidance)",
                                                      "a report of feedback_node (/diagnostics)"}));
}

TEST(Readiness, A1_waits_for_a_guide_that_never_starts) {
  Readiness ready({});
  ready.saw_odometry(10.0);
  ready.saw(guidance(Guidance::State::no_goal), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{"a report of feedback_node (/diagnostics)"});
  ready.saw({0, "audio", DeviceState::missing}, 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{});
}

TEST(Readiness, needs_messages_that_still_flow_and_a_map) {
  Readiness ready({});
  ready.saw_odometry(10.0);
  ready.saw({0, "audio", DeviceState::works}, 10.0);
  ready.saw(guidance(Guidance::State::no_map), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{"a map (/octomap_binary or /map)"});
  ready.saw(guidance(Guidance::State::pose_stale), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{"a pose (transforms from map to base_link)"});
  ready.saw(guidance(Guidance::State::no_goal), 10.0);
  EXPECT_EQ(ready.missing(10.5, true), Words{});
  EXPECT_EQ(ready.missing(12.0, true),
            (Words{"odometry (/odom)", "guidance of nav_node (/navvi/guidance)"}));
  EXPECT_EQ(ready.silence(12.0), 2.0);
}

TEST(Readiness, calls_topics_and_frames_as_this_session_does) {
  SourceNames names;
  names.odometry = "/tb3/odom";
  names.grid = "/tb3/map";
  names.map_frame = "tb3/map";
  Readiness ready({}, names);
  EXPECT_EQ(ready.missing(0.0, true).at(0), "odometry (/tb3/odom)");
  ready.saw_odometry(0.0);
  ready.saw(guidance(Guidance::State::no_map), 0.0);
  EXPECT_EQ(ready.missing(0.0, true).at(0), "a map (/octomap_binary or /tb3/map)");
  ready.saw(guidance(Guidance::State::pose_stale), 0.0);
  EXPECT_EQ(ready.missing(0.0, true).at(0), "a pose (transforms from tb3/map to base_link)");
}

TEST(Readiness, waits_for_the_connection_where_the_robot_is_on_another_machine) {
  SourceNames names;
  names.link = "/navvi/link";
  Readiness ready({}, names);
  ready.saw_odometry(0.0);
  ready.saw(guidance(Guidance::State::no_goal), 0.0);
  ready.saw({0, "audio", DeviceState::works}, 0.0);
  EXPECT_EQ(ready.missing(0.0, true),
            Words{"the state of the connection to the robot (/navvi/link)"});
  ready.saw(LinkState{}, 0.0);
  EXPECT_EQ(ready.missing(0.0, true), Words{});
}

TEST(Readiness, says_of_each_device_what_was_last_reported) {
  Readiness ready({});
  EXPECT_EQ(ready.state_of("audio"), "unknown");
  for (const DeviceState state : {DeviceState::works, DeviceState::missing, DeviceState::off}) {
    ready.saw({0, "audio", state}, 0.0);
    EXPECT_EQ(ready.state_of("audio"), navvi_types::to_string(state));
  }
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
  for (const auto& [modality, needed] : {std::pair{"rumble", Words{"a working pad device"}},
                                         {"speech", {"a working audio device", "a working speech device"}}}) {
    Readiness one({modality});
    one.saw_odometry(0.0);
    one.saw(guidance(Guidance::State::no_goal), 0.0);
    one.saw({0, "keys", DeviceState::works}, 0.0);
    EXPECT_EQ(one.missing(0.1, true), needed);
  }
}

TEST(Readiness, keeps_what_a_device_says_of_itself) {
  Readiness ready({});
  EXPECT_EQ(ready.trait("pad", "name"), "unknown");
  ready.saw({0, "pad", DeviceState::works, {{"name", "some pad"}}}, 0.0);
  EXPECT_EQ(ready.trait("pad", "name"), "some pad");
  EXPECT_EQ(ready.trait("pad", "colour"), "unknown");
}

}  // namespace
}  // namespace navvi_study::trial
