#include "cues/halt.hpp"

#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

const Texts kWait = {"wait, worker in the way"};
const Texts kGoOn = {"go on, drive straight, 20 meters"};

class HaltTest : public CuePolicyTest {
 protected:
  HaltTest() { under_way(); }

  /// Told to wait for what has gone meanwhile.
  void wait_and_stand() {
    block();
    pass(1.0);
    drive(0.0);
    follow();
  }
  /// One that nears a robot which drives at 0.3 m/s, until there is a word to stop.
  Texts meet(NearThing& forklift, bool asking) {
    Texts said;
    while (last_.kind != CueKind::obstacle_stop && forklift.gap > 0.0) {
      forklift.gap -= 0.006;
      forklift.nearest.x() -= 0.006;
      now_.nearby = {forklift};
      if (asking) asked_.question = Button::repeat;
      said = pass(0.02);
    }
    return said;
  }
  NearThing forklift_{ThingClass::forklift, 5, 1.8, {2.2, 0.0}, true};
};

TEST_F(HaltTest, holds_a_wait_until_a_person_can_have_obeyed_it) {
  now_.guidance->blocked_distance = 5.0;
  block();
  EXPECT_EQ(pass(0.6), kWait);
  follow();
  EXPECT_EQ(pass(1.5), Texts{}) << "the way is clear, but they have only just let go";
  EXPECT_EQ(pass(1.0), kGoOn);
}

TEST_F(HaltTest, holds_a_wait_that_was_asked_for_again_but_not_for_ever) {
  block();
  pass(1.0);
  const auto heard = [&] { note(1, {CueStage::started}); };
  heard();
  pass(1.0);
  EXPECT_EQ(ask(Button::repeat), kWait);
  heard();
  follow();
  EXPECT_EQ(pass(1.8), Texts{}) << "what was just called in the way";
  EXPECT_EQ(pass(0.4), kGoOn);

  block();
  pass(5.0);
  follow();
  heard();
  for (int i = 0; i < 12 && last_.kind == CueKind::blocked; ++i) {
    ask(Button::repeat, 1.0);
    heard();
  }
  EXPECT_EQ(last_.kind, CueKind::straight);
}

TEST_F(HaltTest, says_go_on_to_nobody_whom_something_will_reach_but_not_for_ever) {
  wait_and_stand();
  // 0.8 m/s from the left: that it comes is said 3 s before, soon after the wait would be over.
  const auto comes_for = [&](double seconds) {
    Texts texts;
    for (int i = 0; i < std::lround(seconds / 0.1); ++i) {
      const double gap = now_.nearby.empty() ? 4.0 : now_.nearby[0].gap - 0.08;
      now_.nearby = {{ThingClass::forklift, 5, gap, {0.0, gap + 0.3}, true}};
      for (const std::string& text : pass(0.1)) texts.push_back(text);
    }
    return texts;
  };
  EXPECT_EQ(comes_for(3.5), Texts{"forklift coming, on your left"});
  now_.nearby.clear();
  EXPECT_EQ(pass(1.0), kGoOn) << "it has passed";

  wait_and_stand();
  Texts told;
  for (int i = 0; i < 5 && told.empty(); ++i) {
    now_.nearby.clear();  // one after another
    told = comes_for(2.0);
  }
  EXPECT_EQ(told, kGoOn);
}

TEST_F(HaltTest, says_go_on_to_nobody_who_would_meet_what_moves_on_the_way) {
  wait_and_stand();
  // It crosses 2 m ahead, from the left: nothing reaches a robot that stays.
  Texts told;
  double y = 4.0;
  for (; y > -3.0 && told.empty(); y -= 0.1) {
    const Eigen::Vector2d at(2.0, y);
    now_.nearby = {{ThingClass::forklift, 5, at.norm() - 0.35, at, true}};
    told = pass(0.1);
  }
  EXPECT_EQ(told, kGoOn);
  EXPECT_LT(y, 2.0) << "it will be past";
}

TEST_F(HaltTest, C8_says_go_on_to_nobody_while_the_emergency_stop_is_pressed) {
  wait_and_stand();
  now_.gate = DriveState::State::stopped;
  now_.notices = now_.devices.states = {CueKind::emergency_stop};
  const Texts told = {"robot stopped, release the stick", "the emergency stop is pressed"};
  EXPECT_EQ(pass(30.0), told);
  EXPECT_EQ(policy_.order().value().kind, CueKind::emergency_stop);
  now_.gate = DriveState::State::running;
  now_.notices.clear();
  now_.devices.states.clear();
  EXPECT_EQ(pass(1.0), kGoOn);
}

TEST_F(HaltTest, ends_a_wait_by_the_word_to_make_room) {
  block(ThingClass::forklift);
  lead_to(1.0, 0.0, 0.0, 1.0);
  pass(5.0);
  now_.guidance->state = Guidance::State::make_room;
  lead_to(-3.0, 0.0, 3.1, 3.0);
  EXPECT_EQ(pass(2.0), Texts{"go on, move to 6 o'clock, 3 meters, to let a forklift pass"});
}

TEST_F(HaltTest, answers_a_question_by_the_wait_however_often_and_that_ends_by_go_on) {
  block();
  now_.guidance->blocked_distance = 5.0;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(Button::repeat, 0.2), kWait);
  follow();
  EXPECT_EQ(pass(3.0), kGoOn);
}

TEST_F(HaltTest, takes_back_no_wait_for_an_older_word_that_was_never_heard) {
  block();
  EXPECT_EQ(pass(0.6).size(), 1U);
  const CueEvent older{1, CueStage::queued, Content(last_), last_.text};
  const CueEvent newer{2, CueStage::queued, navvi_types::Spoken(CueKind::obstacle_stop),
                       "stop, box ahead"};
  policy_.note({older, newer});
  note(1, {CueStage::dropped});
  follow();
  EXPECT_EQ(pass(3.0), kGoOn);
}

TEST_F(HaltTest, answers_no_way_in_the_moment_of_a_word_to_stop) {
  EXPECT_EQ(meet(forklift_, true), Texts{"stop, forklift ahead"});
}

TEST_F(HaltTest, nothing_cuts_the_word_to_stop_and_the_way_on_follows_it) {
  EXPECT_EQ(meet(forklift_, false), Texts{"stop, forklift ahead"});
  EXPECT_LT(forklift_.gap, 0.8);
  EXPECT_EQ(last_.priority, Priority::important);
  stand();
  EXPECT_EQ(pass(4.0), Texts{}) << "it is still there";
  now_.nearby.clear();
  EXPECT_EQ(pass(1.0), kGoOn);
}

TEST_F(HaltTest, says_the_same_once_more_in_other_words) {
  now_.lead = Lead::ticks;
  now_.guidance->blocked_distance = 5.0;
  for (const char* wait : {"wait, worker in the way", "wait again, worker"}) {
    block();
    EXPECT_EQ(pass(1.0), Texts{wait});
    follow();
    EXPECT_EQ(pass(3.0), kGoOn);
  }
  pass(10.0);
  block();
  EXPECT_EQ(pass(1.0), kWait) << "that is long ago";
}

TEST_F(HaltTest, says_go_on_to_nobody_whose_robot_senses_nothing_but_not_for_ever) {
  wait_and_stand();
  const auto goes_on = [&](double seconds) {
    const Texts said = pass(seconds);
    return std::find(said.begin(), said.end(), kGoOn[0]) != said.end();
  };
  now_.links.proximity = Link::lost;
  EXPECT_FALSE(goes_on(4.0));
  now_.links.proximity = Link::alive;
  EXPECT_TRUE(goes_on(3.0));

  wait_and_stand();
  now_.links.proximity = Link::lost;
  EXPECT_FALSE(goes_on(7.5));
  EXPECT_TRUE(goes_on(2.0)) << "as where what is ahead stays";
}

}  // namespace
}  // namespace navvi_feedback::cues
