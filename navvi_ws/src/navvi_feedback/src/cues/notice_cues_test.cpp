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

}  // namespace
}  // namespace navvi_feedback::cues
