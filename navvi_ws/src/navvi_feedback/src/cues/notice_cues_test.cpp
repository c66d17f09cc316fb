#include "cues/notice_cues.hpp"

#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class NoticeCuesTest : public CuePolicyTest {};

TEST_F(NoticeCuesTest, says_a_notice_once) {
  under_way();
  now_.notices = {{CueKind::notice, About::no_rumble}};
  EXPECT_EQ(pass(3.0), Texts{"this controller cannot rumble"});
  now_.notices.clear();
  EXPECT_EQ(pass(6.0), Texts{});
  now_.notices = {{CueKind::notice, About::no_rumble}};
  EXPECT_EQ(pass(1.0), Texts{"this controller cannot rumble"}) << "another controller";
}

TEST_F(NoticeCuesTest, says_a_little_later_what_returns_too_soon_if_it_lasts) {
  now_.guidance.reset();
  now_.zone = "press shop";
  for (const Content& notice : std::vector<Content>{CueKind::emergency_stop,
                                                    CueKind::pad_too_late,
                                                    CueKind::record_lost,
                                                    {CueKind::notice, About::two_drivers},
                                                    {CueKind::notice, About::zone_slow}}) {
    const auto told = [&](bool there, double seconds) {
      now_.notices.clear();
      if (there) now_.notices = {notice};
      return pass(seconds).size();
    };
    EXPECT_EQ(told(true, 0.5), 1U) << to_string(notice);
    EXPECT_EQ(told(false, 0.5), 0U) << to_string(notice);
    EXPECT_EQ(told(true, 5.0), 1U) << to_string(notice) << " is there again";
    EXPECT_EQ(told(true, 30.0), 0U) << to_string(notice) << ", once";
    told(false, 1.0);
    told(true, 0.5);
    told(false, 0.5);
    told(true, 0.5);
    EXPECT_EQ(told(false, 30.0), 0U) << to_string(notice) << " is over";
  }
}

TEST_F(NoticeCuesTest, names_a_zone_and_the_person_whose_settings_are_used) {
  under_way();
  now_.zone = "press shop";
  now_.devices.person = "sub-01_b";
  for (const auto& [notice, text] : std::vector<std::pair<Content, const char*>>{
           {{CueKind::notice, About::zone_keep_out}, "closed zone, press shop"},
           {{CueKind::notice, About::zone_slow}, "slow zone, press shop"},
           {{CueKind::settings, About::of}, "settings of sub-01 b"}}) {
    now_.notices = {notice};
    EXPECT_EQ(pass(3.0), Texts{text});
  }
}

TEST_F(NoticeCuesTest, gives_no_direction_right_after_the_end_of_a_trial) {
  under_way();
  now_.notices = {{CueKind::trial_ends, About::time_up}};
  EXPECT_EQ(pass(0.02), Texts{"time is up, the trial is over"});
  now_.notices.clear();
  now_.guidance->steer_angle = now_.guidance->waypoint_angle = 2.0;
  EXPECT_EQ(pass(9.0), Texts{});
  EXPECT_EQ(pass(2.0), Texts{"turn to 4 o'clock, 20 meters"}) << "the session goes on";
}

TEST_F(NoticeCuesTest, gives_directions_again_as_soon_as_the_next_trial_runs) {
  under_way();
  now_.trial = TrialState::State::running;
  now_.notices = {{CueKind::trial_ends, About::time_up}};
  pass(1.0);
  EXPECT_FALSE(policy_.leads()) << "the last state of that trial comes once more";
  now_.notices.clear();
  now_.trial = TrialState::State::preparing;
  now_.guidance->steer_angle = now_.guidance->waypoint_angle = 2.0;
  EXPECT_EQ(pass(3.0), Texts{});
  now_.trial = TrialState::State::running;
  EXPECT_EQ(pass(2.0), Texts{"turn to 4 o'clock, 20 meters"});
  EXPECT_TRUE(policy_.leads());
}

}  // namespace
}  // namespace navvi_feedback::cues
