#include "core/side_question.hpp"

#include <gtest/gtest.h>

#include "guide_fixture.hpp"

namespace navvi_feedback::core {
namespace {

/// A person who is asked, and moves the stick `hand` times to the side of the sound.
struct Asked {
  std::optional<bool> answer;
  int sounds = 0;
  bool asks = false;
};
Asked ask(SideQuestion& question, double hand, double seconds, bool may = true) {
  Asked asked;
  double side = 0.0;
  for (double time = 7.0; time < 7.0 + seconds; time += 0.02) {
    const double aside = time > 9.0 ? hand * side : 0.0;
    if (const auto answer = question.update(may, true, aside, time)) asked.answer = answer;
    if (question.sounds()) {
      side = *question.sounds();
      ++asked.sounds;
    }
  }
  asked.asks = question.asks();
  return asked;
}

TEST(SideQuestion, is_answered_by_the_stick_once_its_words_were_heard) {
  for (const bool right : {true, false}) {
    SideQuestion question;
    EXPECT_EQ(ask(question, 1.0, 5.0).sounds, 0);
    EXPECT_TRUE(question.asks());
    question.told();
    const Asked asked = ask(question, right ? 1.0 : -1.0, 5.0);
    EXPECT_GE(asked.sounds, 2);
    EXPECT_EQ(asked.answer, right);
    EXPECT_FALSE(asked.asks);
    EXPECT_EQ(ask(question, 1.0, 20.0).sounds, 0) << "once";
  }
}

TEST(SideQuestion, waits_for_no_answer_for_ever_and_ends_with_the_begin_of_a_trial) {
  SideQuestion silent;
  silent.told();
  const Asked asked = ask(silent, 0.0, 13.0);
  EXPECT_FALSE(asked.answer);
  EXPECT_FALSE(asked.asks);
  SideQuestion begun;
  begun.told();
  EXPECT_TRUE(ask(begun, 0.0, 2.0).asks);
  EXPECT_FALSE(ask(begun, 0.0, 0.1, false).asks);
  EXPECT_FALSE(ask(begun, 0.0, 1.0).asks);
}

TEST(SideQuestion, takes_a_stick_that_is_held_before_the_sound_for_no_answer) {
  SideQuestion question;
  question.told();
  for (double time = 7.0; time < 9.0; time += 0.02)
    EXPECT_FALSE(question.update(true, true, 1.0, time));
}

/// A session with headphones, before a trial.
class SidesTest : public GuideTest {
 protected:
  SidesTest() {
    input_.ears = "usb_headphones";
    input_.person = "ada";
    state_.state = TrialState::State::ready;
  }
  /// Hears what is said to its end, and sounds. \return the last change of a setting
  std::string wait(double seconds) {
    std::string change;
    for (const double end = time_ + seconds; time_ < end - 1e-9;) {
      guide_.take(state_, time_);
      guide_.take(Odometry{}, time_);
      const Beat output = pass(0.02);
      if (!output.change.empty()) change = output.change;
      for (const sounds::Play& play : output.plays) side_ = play.from.y();
    }
    return change;
  }
  /// A sound that lasts leads straight on in the trial, where one is to.
  bool flows() {
    GuideConfig config;
    config->lead = "flow";
    guide_.use(config);
    state_.state = TrialState::State::running;
    wait(2.0);
    Guidance guidance;
    guidance.state = Guidance::State::following;
    guidance.goal = {20.0, 0.0};
    guidance.waypoint_distance = guidance.goal_distance = 20.0;
    guide_.take(guidance, time_);
    const haptics::Rumble flow = pass(0.1).flow;
    return flow.left + flow.right > 0.0;
  }

  TrialState state_;
  double side_ = 0.0;
};

TEST_F(SidesTest, F7_are_asked_for_first_and_kept_with_the_sound_device) {
  EXPECT_EQ(wait(2.0), "");
  EXPECT_TRUE(said(CueKind::which_side));
  EXPECT_EQ(guide_.order().value().kind(), CueKind::which_side);
  ASSERT_NE(side_, 0.0);
  EXPECT_FALSE(said({CueKind::press, About::start}));
  hold(side_, 0.0);
  EXPECT_EQ(wait(1.0), "sounds/sides:=usb_headphones");
  EXPECT_TRUE(said({CueKind::press, About::start}));
  EXPECT_FALSE(said(CueKind::sides_wrong));
  EXPECT_FALSE(guide_.learnt().value().words_lead);
  EXPECT_TRUE(flows());
}

TEST_F(SidesTest, F7_that_are_wrong_are_told_and_words_lead) {
  wait(2.0);
  hold(-side_, 0.0);
  EXPECT_EQ(wait(1.0), "");
  EXPECT_TRUE(said(CueKind::sides_wrong));
  EXPECT_TRUE(said({CueKind::press, About::start}));
  EXPECT_TRUE(guide_.learnt().value().words_lead);
  EXPECT_FALSE(flows()) << "no sound that lasts leads either";
}

TEST_F(SidesTest, are_not_asked_for_where_they_are_known_or_nothing_sounds) {
  GuideConfig known;
  known->sounds.sides = "usb_headphones";
  guide_.use(known);
  wait(1.0);
  guide_.use({});
  input_.sounds = false;
  wait(1.0);
  input_.sounds = true;
  input_.ears.clear();  // a simulated person
  wait(1.0);
  input_.ears = "usb_headphones";
  for (const char* lead : {"hand", "words"}) {
    GuideConfig no_sound_leads;
    no_sound_leads->lead = lead;
    guide_.use(no_sound_leads);
    wait(1.0);
  }
  EXPECT_FALSE(said(CueKind::which_side));
  guide_.use({});
  wait(3.0);
  EXPECT_TRUE(said(CueKind::which_side));
}

}  // namespace
}  // namespace navvi_feedback::core
