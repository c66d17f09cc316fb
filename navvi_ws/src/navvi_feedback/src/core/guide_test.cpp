#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

#include "guide_fixture.hpp"

namespace navvi_feedback::core {
namespace {

TEST_F(GuideTest, says_once_that_another_node_wants_to_drive) {
  pass(1.0);
  DriveState drive;
  drive.state = DriveState::State::running;
  drive.intruder = "/teleop";
  guide_.take(drive, time_);
  pass(5.0);
  EXPECT_EQ(count({CueKind::notice, About::intruder}), 1);
}

TEST_F(GuideTest, J1_a_stick_drives_once_it_was_neutral_and_its_loss_is_one_last_zero) {
  pass(0.5);
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command.value().linear, 0.5);
  ++input_.hands.session;
  EXPECT_EQ(pass(1.0).command.value().linear, 0.0) << "opened anew, it must be neutral again";
  hold(0.0, 0.0);
  pass(0.5);
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command.value().linear, 0.5);
  input_.hands = {};
  const Beat lost = pass(0.02);
  ASSERT_TRUE(lost.command);
  EXPECT_EQ(lost.command->linear, 0.0);
  EXPECT_FALSE(pass(0.02).command);
  EXPECT_TRUE(said({CueKind::stick_lost, About::pad}));
}

TEST_F(GuideTest, a_stick_that_a_busy_computer_delays_is_to_be_released_and_not_lost) {
  pass(0.5);
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command->linear, 0.5);
  input_.hands.live = false;
  input_.hands.late = true;
  pass(0.02);
  EXPECT_FALSE(pass(0.5).command) << "after one last zero";
  input_.hands.live = true;
  input_.hands.late = false;
  EXPECT_EQ(pass(0.6).command->linear, 0.0);
  EXPECT_FALSE(said({CueKind::stick_lost, About::pad}) || said(CueKind::pad_back));
  input_.hands.live = false;
  pass(0.02);
  EXPECT_TRUE(said({CueKind::stick_lost, About::pad}));
}

TEST_F(GuideTest, S7_a_pause_of_ten_minutes_ends_without_a_burst_of_speech) {
  const auto live = [&](double seconds) {
    for (const double end = time_ + seconds; time_ < end - 1e-9; pass(0.06)) lead(0.5);
  };
  live(10.0);
  const std::size_t at_first = told_.size();
  told_.clear();
  pass(600.0);
  EXPECT_TRUE(said({CueKind::robot_lost, About::odometry}));
  EXPECT_LE(told_.size(), 4U) << "each loss is said once";
  told_.clear();
  live(10.0);
  EXPECT_TRUE(said(CueKind::direction));
  EXPECT_LE(told_.size(), at_first + 1) << "as at the begin";
}

class Driven : public GuideTest {
 protected:
  /// m/s, with the stick `axes` and the buttons held for 2 s after it was neutral.
  double speed(const std::string& parameters, const std::vector<double>& axes,
               const std::vector<bool>& buttons = {}) {
    GuideConfig config;
    navvi_config::read(config, YAML::Load(parameters), "test");
    Guide guide(config, cues::Phrases(kEnglish));
    Beat output;
    for (int tick = 0; tick < 125; ++tick, time_ += 0.02) {
      input_.hands.axes = tick < 25 ? std::vector<double>(axes.size()) : axes;
      input_.hands.buttons = buttons;
      output = beat(guide, input_, time_);
    }
    return output.command.value().linear;
  }
};

TEST_F(Driven, by_the_hand_that_is_wanted) {
  EXPECT_GT(speed("{drive: {stick: right}}", {0.0, 0.0, 0.0, 1.0}), 0.5);
  EXPECT_EQ(speed("{drive: {stick: right}}", {0.0, 1.0, 0.0, 0.0}), 0.0);
  EXPECT_GT(speed("{drive: {stick: right}}", {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0}), 0.5);
  EXPECT_EQ(speed("{drive: {stick: right}}", {0.0, 1.0}), 0.0) << "there is no right one";
}

TEST_F(Driven, only_while_the_button_for_it_is_held_but_without_that_by_keys) {
  EXPECT_EQ(speed("{drive: {enable: 1}}", {0.0, 1.0}), 0.0);
  EXPECT_GT(speed("{drive: {enable: 1}}", {0.0, 1.0}, {false, true}), 0.5);
  input_.keyboard = true;
  EXPECT_GT(speed("{drive: {enable: 9}}", {0.0, 1.0}), 0.5);
}

TEST_F(GuideTest, nothing_moves_before_the_person_has_begun_the_trial) {
  const auto hold_start = [&](bool down) { input_.hands.buttons = std::vector<bool>(7, down); };
  guide_.take(Odometry{}, time_);
  guide_.take(TrialState{TrialState::State::ready}, time_);
  pass(0.6);
  EXPECT_TRUE(said({CueKind::press, About::start}));
  told_.clear();
  hold(0.0, 1.0);
  bool felt = false;
  for (int tick = 0; tick < 200; ++tick) {
    guide_.take(Odometry{}, time_);
    const Beat out = pass(0.02);
    EXPECT_EQ(out.command.value().linear, 0.0);
    felt = felt || out.pattern == haptics::Pattern::ready;
  }
  EXPECT_TRUE(felt) << "the reason, to a stick that is pushed; its words were said just now";
  EXPECT_FALSE(said(CueKind::release_stick));

  hold(0.0, 0.0);
  hold_start(true);
  EXPECT_EQ(pass(0.02).request, TrialRequest::Kind::begin);
  EXPECT_FALSE(pass(0.02).request) << "held";
  hold_start(false);
  guide_.take(TrialState{TrialState::State::running}, time_);
  EXPECT_EQ(pass(0.02).pattern, haptics::Pattern::begun);
  EXPECT_TRUE(said(CueKind::trial_begins));
  pass(0.5);
  hold_start(true);
  EXPECT_FALSE(pass(0.02).request) << "it has begun";
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command.value().linear, 0.5);
}

TEST_F(GuideTest, L5_a_trial_node_that_is_halted_is_told_while_its_trial_runs) {
  const TrialState running{TrialState::State::running};
  const auto beat = [&](double seconds) {
    for (const double end = time_ + seconds; time_ < end;) {
      guide_.take(running, time_);
      pass(0.25);
    }
  };
  guide_.take(running, time_);
  pass(5.0);
  EXPECT_FALSE(said(CueKind::record_lost)) << "one that tells its state once is not missed";
  beat(5.0);
  EXPECT_FALSE(said(CueKind::record_lost));
  pass(2.2);
  EXPECT_TRUE(said(CueKind::record_lost));
  told_.clear();
  beat(6.0);
  EXPECT_FALSE(said(CueKind::record_lost));
  guide_.take(TrialState{TrialState::State::preparing}, time_);
  guide_.take(TrialState{TrialState::State::preparing}, time_);
  pass(5.0);
  EXPECT_FALSE(said(CueKind::record_lost)) << "nothing is recorded between trials";
  hold(0.0, 1.0);
  EXPECT_EQ(pass(0.5).command->linear, 0.0) << "the stick is held";
  hold(0.0, 0.0);
  pass(2.0);
  EXPECT_TRUE(said(CueKind::record_lost));
  hold(0.0, 1.0);
  EXPECT_GT(pass(1.0).command->linear, 0.5) << "by nobody who could let it go";
}

TEST_F(GuideTest, L5_a_trial_node_that_is_halted_before_its_trial_leaves_the_person_led) {
  for (int times = 0; times < 2; ++times) {
    guide_.take(TrialState{TrialState::State::ready}, time_);
    drive_along(2.0, 2);
  }
  EXPECT_TRUE(said({CueKind::press, About::start}));
  drive_along(2.0, 14);
  EXPECT_TRUE(said(CueKind::record_lost));
  told_.clear();
  drive_along(2.0, 40);
  EXPECT_FALSE(said({CueKind::press, About::start})) << "to nobody who could begin it";
  EXPECT_TRUE(said(CueKind::direction));
}

TEST_F(GuideTest, an_emergency_stop_that_the_robot_alone_knows_of_is_told) {
  DriveState drive;
  drive.state = DriveState::State::stopped;
  drive.reason = DriveState::Reason::emergency_stop;
  guide_.take(drive, time_);
  pass(1.0);
  EXPECT_EQ(count(CueKind::emergency_stop), 1);
}

TEST_F(GuideTest, the_end_of_a_trial_by_the_end_of_the_session_is_felt_to_its_end) {
  guide_.take(TrialState{TrialState::State::running}, time_);
  pass(1.0);
  ASSERT_TRUE(guide_.end_session());
  pass(0.02);
  int pulses = 0;
  bool on = false;
  const auto hear_out = [&] {
    const double left = guide_.hear_out(input_, time_ += 0.02).rumble.left;
    pulses += left > 0.0 && !on ? 1 : 0;
    on = left > 0.0;
  };
  while (guide_.has_last_words() && time_ < 20.0) hear_out();
  EXPECT_EQ(pulses, 2);
  hear_out();
  EXPECT_FALSE(on);
}

TEST_F(GuideTest, the_record_of_the_motors_ends_where_they_are_lost) {
  double left = 0.0;
  const auto recorded = [&](double seconds) {
    for (const double end = time_ + seconds; time_ < end - 1e-9;)
      if (const Beat out = pass(0.02); out.felt) left = out.felt->left;
    return left;
  };
  const auto come_near = [&] {
    guide_.take(Odometry{}, time_);
    guide_.take(Proximity{0, {{ThingClass::worker, 1, 0.5, {0.9, 0.0}, true}}}, time_);
  };
  come_near();
  EXPECT_GT(recorded(0.5), 0.1);
  input_.felt = false;
  EXPECT_EQ(recorded(0.1), 0.0);
  guide_.take(Proximity{}, time_);
  recorded(0.1);
  input_.felt = true;
  EXPECT_EQ(recorded(0.1), 0.0);
  come_near();
  EXPECT_GT(recorded(0.5), 0.1);
}

TEST_F(GuideTest, says_each_time_to_who_has_no_motors_what_others_feel) {
  input_.keyboard = true;
  input_.felt = false;
  hold(0.0, 1.0);
  int words = 0;
  for (int i = 0; i < 300; ++i) {
    lead(5.0);
    for (const cues::Cue& cue : pass(0.02).cues)
      if (cue.kind == CueKind::release_stick && !cue.felt) ++words;
  }
  EXPECT_EQ(words, 3);
}

TEST_F(GuideTest, a_button_that_is_held_asks_once_and_so_does_what_is_asked_elsewhere) {
  pass(5.5);
  for (const bool elsewhere : {false, true}) {
    pass(0.5);
    told_.clear();
    if (elsewhere) ask({drive::Button::repeat});
    input_.hands.buttons = {!elsewhere, false};
    pass(2.0);
    EXPECT_EQ(std::count(told_.begin(), told_.end(), CueKind::answer), 1) << elsewhere;
    hold(0.0, 0.0);
  }
}

TEST_F(GuideTest, guidance_is_kept_but_not_fresh_for_ever) {
  EXPECT_FALSE(guide_.guidance());
  Guidance guidance;
  guidance.seq = 5;
  guide_.take(guidance, time_);
  EXPECT_TRUE(guide_.guidance_fresh(time_ + 0.7));
  EXPECT_FALSE(guide_.guidance_fresh(time_ + 0.9));
  EXPECT_EQ(guide_.guidance().value().seq, 5U);
}

}  // namespace
}  // namespace navvi_feedback::core
