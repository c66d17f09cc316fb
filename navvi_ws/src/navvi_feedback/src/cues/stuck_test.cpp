#include "cues/stuck.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class StuckTest : public CuePolicyTest {};

TEST_F(StuckTest, says_what_blocks_a_stuck_robot) {
  under_way();
  now_.nearby = {{ThingClass::box, 1, 0.15, {-0.1, -0.5}, false},
                 {ThingClass::pallet_robot, 2, 0.2, {0.6, 0.0}, true}};
  now_.measured->linear = 0.0;
  EXPECT_EQ(pass(1.4), Texts{});
  EXPECT_EQ(pass(0.3), Texts{"back away, pallet robot ahead"});
  now_.nearby.clear();
  const Texts later = pass(6.0);
  EXPECT_EQ(std::count(later.begin(), later.end(), "stuck"), 2);
}

TEST_F(StuckTest, calls_no_robot_stuck_that_is_not_driven_or_is_held) {
  under_way();
  now_.commanded = {};
  now_.measured = Velocity{};
  Texts texts = pass(10.0);
  now_.commanded.linear = 1.0;
  now_.gate = DriveState::State::waiting;
  for (const std::string& text : pass(10.0)) texts.push_back(text);
  now_.gate = DriveState::State::running;
  now_.measured.reset();
  for (const std::string& text : pass(10.0)) texts.push_back(text);
  for (const std::string& text : texts) EXPECT_EQ(text.find("stuck"), std::string::npos);
}

}  // namespace
}  // namespace navvi_feedback::cues
