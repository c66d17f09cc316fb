#include "cues/halt.hpp"

#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class HaltTest : public CuePolicyTest {};

TEST_F(HaltTest, says_to_wait_for_what_is_in_the_way_and_then_to_go_on) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::forklift;
  EXPECT_EQ(pass(5.0), Texts{"wait, forklift in the way"});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(1.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(HaltTest, holds_a_wait_until_a_person_can_have_obeyed_it) {
  under_way();
  now_.guidance->blocked_distance = 5.0;
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  EXPECT_EQ(pass(0.6), Texts{"wait, worker in the way"});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(1.5), Texts{}) << "the way is clear, but they have only just let go";
  EXPECT_EQ(pass(1.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(HaltTest, holds_a_wait_that_was_asked_for_again_but_not_for_ever) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  pass(1.0);
  const auto heard = [&] { policy_.note({{1, CueStage::started, Content(last_), last_.text}}); };
  heard();
  pass(1.0);
  asked_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{"wait, worker in the way"});
  heard();
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(1.8), Texts{}) << "what was just called in the way";
  EXPECT_EQ(pass(0.4), Texts{"go on, drive straight, 20 meters"});

  now_.guidance->state = Guidance::State::blocked;
  pass(5.0);
  now_.guidance->state = Guidance::State::following;
  heard();
  for (int i = 0; i < 12 && last_.kind == CueKind::blocked; ++i) {
    asked_.question = Question::way;
    pass(1.0);
    heard();
  }
  EXPECT_EQ(last_.kind, CueKind::straight);
}

TEST_F(HaltTest, says_go_on_to_nobody_whom_something_will_reach_but_not_for_ever) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  pass(1.0);
  now_.commanded.linear = now_.measured->linear = 0.0;
  now_.guidance->state = Guidance::State::following;
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
  EXPECT_EQ(pass(1.0), Texts{"go on, drive straight, 20 meters"}) << "it has passed";

  now_.guidance->state = Guidance::State::blocked;
  pass(1.0);
  now_.guidance->state = Guidance::State::following;
  Texts told;
  for (int i = 0; i < 5 && told.empty(); ++i) {
    now_.nearby.clear();  // one after another
    told = comes_for(2.0);
  }
  EXPECT_EQ(told, Texts{"go on, drive straight, 20 meters"});
}

TEST_F(HaltTest, ends_a_wait_by_the_word_to_make_room) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::forklift;
  now_.guidance->waypoint = {1.0, 0.0};
  now_.guidance->waypoint_distance = 1.0;
  pass(5.0);
  now_.guidance->state = Guidance::State::make_room;
  now_.guidance->waypoint = {-3.0, 0.0};
  now_.guidance->waypoint_distance = 3.0;
  now_.guidance->waypoint_angle = now_.guidance->steer_angle = 3.1;
  EXPECT_EQ(pass(2.0), Texts{"go on, move to 6 o'clock, 3 meters, to let a forklift pass"});
}

TEST_F(HaltTest, an_answer_to_wait_is_a_wait_that_ends_by_go_on) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  now_.guidance->blocked_distance = 5.0;
  asked_.question = Question::way;
  EXPECT_EQ(pass(0.2), Texts{"wait, worker in the way"});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(HaltTest, says_go_on_to_nobody_who_would_meet_what_moves_on_the_way) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  pass(1.0);
  now_.commanded.linear = now_.measured->linear = 0.0;
  now_.guidance->state = Guidance::State::following;
  // It crosses 2 m ahead, from the left: nothing reaches a robot that stays.
  Texts told;
  double y = 4.0;
  for (; y > -3.0 && told.empty(); y -= 0.1) {
    const Eigen::Vector2d at(2.0, y);
    now_.nearby = {{ThingClass::forklift, 5, at.norm() - 0.35, at, true}};
    told = pass(0.1);
  }
  EXPECT_EQ(told, Texts{"go on, drive straight, 20 meters"});
  EXPECT_LT(y, 2.0) << "it will be past";
}

TEST_F(HaltTest, takes_back_no_wait_that_was_never_heard) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(0.6).size(), 1U);
  policy_.note({{1, CueStage::dropped, Content(last_), last_.text}});
  now_.guidance->state = Guidance::State::following;
  for (const std::string& text : pass(3.0)) EXPECT_EQ(text.find("go on"), std::string::npos);
}

TEST_F(HaltTest, takes_back_no_wait_for_an_older_word_that_was_never_heard) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(0.6).size(), 1U);
  const CueEvent older{1, CueStage::queued, Content(last_), last_.text};
  const CueEvent newer{2, CueStage::queued, navvi_types::Spoken(CueKind::obstacle_stop),
                       "stop, box ahead"};
  policy_.note({older, newer});
  CueEvent gone = older;
  gone.stage = CueStage::dropped;
  policy_.note({gone});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(HaltTest, answers_no_way_in_the_moment_of_a_word_to_stop) {
  under_way();
  NearThing forklift{ThingClass::forklift, 5, 1.8, {2.2, 0.0}, true};
  Texts said;
  while (said.empty() && forklift.gap > 0.0) {
    forklift.gap -= 0.006;
    forklift.nearest.x() -= 0.006;
    now_.nearby = {forklift};
    asked_.question = Question::way;
    said = pass(0.02);
    if (last_.kind != CueKind::obstacle_stop) said.clear();
  }
  EXPECT_EQ(said, Texts{"stop, forklift ahead"});
}

TEST_F(HaltTest, a_question_during_a_wait_is_answered_by_it_however_often) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::forklift;
  pass(1.0);
  for (int i = 0; i < 3; ++i) {
    asked_.question = Question::way;
    EXPECT_EQ(pass(0.5), Texts{"wait, forklift in the way"});
  }
}

TEST_F(HaltTest, nothing_cuts_the_word_to_stop_and_the_way_on_follows_it) {
  under_way();
  NearThing forklift{ThingClass::forklift, 5, 1.8, {2.2, 0.0}, true};
  Texts said;
  while (last_.kind != CueKind::obstacle_stop && forklift.gap > 0.0) {
    forklift.gap -= 0.006;
    forklift.nearest.x() -= 0.006;
    now_.nearby = {forklift};
    said = pass(0.02);
  }
  EXPECT_EQ(said, Texts{"stop, forklift ahead"});
  EXPECT_LT(forklift.gap, 0.8);
  EXPECT_EQ(last_.priority, Priority::important);
  now_.commanded = {};
  now_.measured = Velocity{};
  EXPECT_EQ(pass(4.0), Texts{}) << "it is still there";
  now_.nearby.clear();
  EXPECT_EQ(pass(1.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(HaltTest, says_the_same_once_more_in_other_words) {
  under_way();
  now_.lead = Lead::ticks;
  now_.guidance->blocked_distance = 5.0;
  now_.guidance->blocked_by = ThingClass::worker;
  Texts said;
  for (int i = 0; i < 2; ++i) {
    now_.guidance->state = Guidance::State::blocked;
    for (const std::string& text : pass(1.0)) said.push_back(text);
    now_.guidance->state = Guidance::State::following;
    for (const std::string& text : pass(3.0)) said.push_back(text);
  }
  EXPECT_EQ(said, (Texts{"wait, worker in the way", "go on, drive straight, 20 meters",
                         "wait again, worker", "go on, drive straight, 20 meters"}));
  pass(10.0);
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(1.0), Texts{"wait, worker in the way"}) << "that is long ago";
}

}  // namespace
}  // namespace navvi_feedback::cues
