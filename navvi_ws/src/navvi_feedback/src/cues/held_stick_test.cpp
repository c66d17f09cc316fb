#include "cues/held_stick.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::cues {
namespace {

class HeldStickTest : public testing::Test {
 protected:
  HeldStickTest() { now_.gate = DriveState::State::running; }

  /// How often it is said within `seconds`.
  int pass(double seconds) {
    int said = 0;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02)
      if (!held_.update(now_, true, time_).empty()) ++said;
    return said;
  }

  HeldStick held_;
  Observation now_;
  double time_ = 10.0;
};

TEST_F(HeldStickTest, keeps_quiet_while_the_stick_rests_or_drives) {
  EXPECT_EQ(pass(5.0), 0);
  now_.commanded.linear = 0.9;
  EXPECT_EQ(pass(5.0), 0);
}

TEST_F(HeldStickTest, asks_for_a_stick_that_is_held_from_the_beginning_again_and_again) {
  now_.stick_held_unarmed = true;
  EXPECT_EQ(pass(0.4), 0);
  EXPECT_EQ(pass(0.4), 1);
  EXPECT_EQ(pass(12.0), 4);
  EXPECT_EQ(held_.needed(), CueKind::release_stick);
  now_.stick_held_unarmed = false;
  EXPECT_EQ(pass(10.0), 0);
}

TEST_F(HeldStickTest, asks_while_a_shut_gate_is_driven_against) {
  for (const auto gate : {DriveState::State::waiting, DriveState::State::stopped}) {
    now_.gate = gate;
    now_.commanded = {0.0, -0.5};
    EXPECT_EQ(pass(5.0), 2);
    now_.commanded = {};
    EXPECT_EQ(pass(5.0), 0);
  }
}

TEST_F(HeldStickTest, C8_tells_an_emergency_stop_from_a_gate_that_stays_shut_after_it) {
  now_.gate = DriveState::State::stopped;
  now_.commanded.linear = 0.5;
  now_.notices = now_.devices.states = {CueKind::emergency_stop};
  EXPECT_EQ(pass(5.0), 2);
  EXPECT_EQ(held_.needed(), CueKind::emergency_stop);
  now_.devices.states.clear();
  EXPECT_EQ(pass(5.0), 2);
  EXPECT_EQ(held_.needed(), CueKind::release_stick) << "the gate names it still";
  now_.commanded = {};
  EXPECT_EQ(pass(5.0), 0);
  EXPECT_EQ(held_.needed(), CueKind::emergency_stop) << "or a stick at rest would have opened it";
  now_.notices.clear();
  EXPECT_EQ(pass(5.0), 0);
  EXPECT_FALSE(held_.needed());
}

TEST_F(HeldStickTest, C8_knows_a_stop_that_the_gate_alone_names_by_a_stick_that_rested_in_vain) {
  now_.gate = DriveState::State::stopped;
  now_.notices = {CueKind::emergency_stop};
  now_.connection.round_trip = 1.0;
  const auto push_after = [&](double rest) {
    now_.commanded.linear = 0.0;
    pass(rest);
    now_.commanded.linear = 0.5;
    EXPECT_EQ(pass(5.0), 2);
    return held_.needed();
  };
  EXPECT_EQ(push_after(1.5), CueKind::release_stick) << "the gate may be about to open";
  EXPECT_EQ(push_after(2.5), CueKind::emergency_stop);
  EXPECT_EQ(pass(5.0), 2);
  EXPECT_EQ(held_.needed(), CueKind::release_stick) << "it may have been released meanwhile";
  now_.commanded.linear = 0.0;
  pass(0.1);
  EXPECT_EQ(held_.needed(), CueKind::emergency_stop) << "or the gate would open";
  EXPECT_EQ(push_after(0.5), CueKind::release_stick) << "it may be about to";
  now_.notices.clear();
  pass(1.0);
  EXPECT_EQ(held_.needed(), CueKind::release_stick) << "the gate is shut by something else";
  now_.notices = {CueKind::emergency_stop};
  pass(1.0);
  EXPECT_EQ(held_.needed(), CueKind::release_stick) << "another one";
}

TEST_F(HeldStickTest, passes_over_the_moment_that_a_gate_takes_to_open) {
  now_.gate = DriveState::State::waiting;
  now_.commanded.linear = 0.5;
  EXPECT_EQ(pass(0.4), 0);
  now_.gate = DriveState::State::running;
  EXPECT_EQ(pass(1.0), 0);
}

TEST_F(HeldStickTest, does_not_add_to_a_cue_that_asked_for_the_same) {
  now_.stick_held_unarmed = true;
  held_.said(time_);
  EXPECT_EQ(pass(2.4), 0);
  EXPECT_EQ(pass(0.4), 1);
}

}  // namespace
}  // namespace navvi_feedback::cues
