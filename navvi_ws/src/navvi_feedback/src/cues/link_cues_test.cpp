#include "cues/link_cues.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class LinkCuesTest : public CuePolicyTest {};

TEST_F(LinkCuesTest, says_which_messages_never_came) {
  now_ = Observation();
  pass(9.0);
  EXPECT_EQ(pass(2.0), (Texts{"controller disconnected", "the robot does not report its motion"}));
}

TEST_F(LinkCuesTest, N1_says_that_the_guidance_is_lost_and_goes_on_when_it_is_back) {
  under_way();
  now_.links.guidance = Link::lost;
  EXPECT_EQ(pass(1.0), Texts{"the guidance is lost"});
  EXPECT_EQ(pass(10.0), Texts{});
  now_.links.guidance = Link::alive;
  EXPECT_EQ(pass(0.5), Texts{"drive straight, 20 meters"});
}

TEST_F(LinkCuesTest, T3_names_only_the_simulator_when_all_dies_with_it) {
  under_way();
  now_.links.simulator = now_.links.guidance = now_.links.proximity = Link::lost;
  now_.gate = DriveState::State::stopped;
  const CuePolicy before = policy_;
  EXPECT_EQ(pass(30.0), Texts{"the robot does not report its motion"}) << "without a simulator";
  policy_ = before;
  now_.simulated = true;
  EXPECT_EQ(pass(30.0), Texts{"the simulator is lost"});
  EXPECT_EQ(last_.priority, Priority::important);
}

TEST_F(LinkCuesTest, T3_says_each_time_that_the_connection_is_lost_and_that_it_is_back) {
  under_way();
  for (const double seconds : {0.4, 1.0, 3.0})
    for (int i = 0; i < 3; ++i) {
      now_.links.simulator = now_.links.guidance = Link::lost;
      now_.cut_off = true;
      EXPECT_EQ(pass(seconds), Texts{"connection lost"}) << seconds;
      now_.links.simulator = now_.links.guidance = Link::alive;
      now_.cut_off = false;
      const Texts back = pass(seconds);
      ASSERT_FALSE(back.empty()) << seconds;
      EXPECT_EQ(back.front(), "connection back") << seconds;
    }
}

TEST_F(LinkCuesTest, names_only_the_simulator_whichever_of_its_messages_is_missed_first) {
  under_way();
  now_.simulated = true;
  now_.links.proximity = Link::lost;
  EXPECT_EQ(pass(0.1), Texts{});
  now_.links.simulator = now_.links.guidance = Link::lost;
  EXPECT_EQ(pass(30.0), Texts{"the simulator is lost"});
  now_.links.simulator = now_.links.guidance = now_.links.proximity = Link::alive;
  pass(5.0);
  now_.links.proximity = Link::lost;
  EXPECT_EQ(pass(1.0), Texts{"obstacles are not sensed"}) << "where that alone is lost";
}

TEST_F(LinkCuesTest, C6_says_that_a_stick_comes_too_late_and_not_that_it_is_disconnected) {
  under_way();
  now_.links.pad = Link::lost;
  now_.devices.states = now_.notices = {CueKind::pad_too_late};
  EXPECT_EQ(pass(1.0),
            Texts{"the robot stands, controller signals are too late or clocks differ"});
}

TEST_F(LinkCuesTest, distinguishes_a_stopped_robot_from_a_lost_controller) {
  under_way();
  now_.gate = DriveState::State::stopped;
  EXPECT_EQ(pass(1.0), Texts{"robot stopped, release the stick"});
  now_.gate = DriveState::State::running;
  pass(5.0);
  now_.links.pad = Link::lost;
  now_.gate = DriveState::State::stopped;
  EXPECT_EQ(pass(1.0), Texts{"controller disconnected"});
  now_.links.pad = Link::alive;
  EXPECT_EQ(pass(1.0),
            (Texts{"controller connected, release the stick", "drive straight, 20 meters"}));
}

TEST_F(LinkCuesTest, C1_a_guide_that_replaces_a_lost_one_says_once_that_the_robot_is_stopped) {
  const auto told = [&](std::optional<DriveState::State> gate) {
    now_.gate = gate;
    const Texts texts = pass(1.0);
    return std::count(texts.begin(), texts.end(), "robot stopped, release the stick");
  };
  EXPECT_EQ(told(DriveState::State::stopped), 1);
  EXPECT_EQ(told({}), 0) << "a robot that is silent for a while";
  EXPECT_EQ(told(DriveState::State::stopped), 0);
}

TEST_F(LinkCuesTest, says_once_that_a_flapping_device_is_lost_and_is_back_once_steady) {
  now_.devices.keyboard = true;
  under_way();
  const auto flap = [&](Link Links::*link, double seconds) {
    now_.links.*link = Link::lost;
    Texts told = pass(seconds);
    now_.links.*link = Link::alive;
    for (const std::string& text : pass(seconds)) told.push_back(text);
    return told;
  };
  for (const double seconds : {0.1, 1.0, 3.0}) {
    pass(30.0);
    EXPECT_EQ(flap(&Links::pad, seconds).front(), "the keys are off, select the keyboard window");
    Texts told;
    for (int i = 0; i < 20; ++i)
      for (const std::string& text : flap(&Links::pad, seconds)) told.push_back(text);
    EXPECT_EQ(told, Texts{"the keys are off, select the keyboard window"}) << seconds;
    EXPECT_EQ(Content(policy_.order().value()), Content(CueKind::stick_lost, About::keyboard))
        << "what was said is shown";
    EXPECT_EQ(pass(6.0).front(), "the keys are on, release them first");
  }
  pass(30.0);
  Texts told = flap(&Links::proximity, 1.0);
  EXPECT_EQ(told, (Texts{"obstacles are not sensed", "obstacles are sensed again"}));
  for (int i = 0; i < 20; ++i)
    for (const std::string& text : flap(&Links::proximity, 1.0)) told.push_back(text);
  EXPECT_EQ(std::count(told.begin(), told.end(), "obstacles are not sensed"), 2);
  EXPECT_EQ(std::count(told.begin(), told.end(), "obstacles are sensed again"), 1);
}

TEST_F(LinkCuesTest,
       falls_silent_about_the_way_without_a_controller_and_says_it_anew_when_it_is_back) {
  under_way();
  stand();
  now_.guidance->waypoint_angle = now_.guidance->steer_angle = 1.6;
  now_.links.pad = Link::lost;
  EXPECT_EQ(pass(30.0), Texts{"controller disconnected"});
  now_.links.pad = Link::alive;
  EXPECT_EQ(pass(1.0),
            (Texts{"controller connected, release the stick", "turn to 3 o'clock, 20 meters"}));
}

}  // namespace
}  // namespace navvi_feedback::cues
