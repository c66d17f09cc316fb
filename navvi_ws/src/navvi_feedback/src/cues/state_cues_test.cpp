#include "cues/state_cues.hpp"

#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class StateCuesTest : public CuePolicyTest {
 protected:
  void before_a_trial(TrialState::State state) {
    now_.trial = state;
    now_.guidance->state = Guidance::State::no_goal;
  }
};

TEST_F(StateCuesTest, announces_the_arrival_once_and_asks_nobody_then_to_release_the_stick) {
  under_way();
  now_.guidance->state = Guidance::State::arrived;
  EXPECT_EQ(pass(0.1), Texts{"you have reached the goal"});
  now_.stick_held_unarmed = true;  // the trial is over
  EXPECT_EQ(pass(60.0), Texts{});
  now_.links.guidance = Link::lost;
  pass(2.0);
  now_.links.guidance = Link::alive;
  EXPECT_EQ(pass(2.0), Texts{});
}

TEST_F(StateCuesTest, says_go_at_once_and_not_after_the_words_that_asked_for_the_press) {
  before_a_trial(TrialState::State::ready);
  EXPECT_EQ(pass(3.0), Texts{"press start to begin"});
  now_.trial = TrialState::State::running;
  EXPECT_EQ(pass(0.02), Texts{"go"});
  EXPECT_TRUE(last_.asked);
}

TEST_F(StateCuesTest, says_what_is_to_be_done_at_a_place_of_a_job_and_what_to_press_then) {
  before_a_trial(TrialState::State::ready);
  now_.task = TrialState::Task::pick;
  now_.reached = "packing table";
  EXPECT_EQ(pass(3.0), Texts{"packing table, pick, then press start"});
  now_.reached = "not; a name";
  EXPECT_EQ(pass(3.0), Texts{"press start to begin"});
}

TEST_F(StateCuesTest, does_not_ask_into_an_open_menu_for_what_is_chosen_there) {
  before_a_trial(TrialState::State::choose_goal);
  EXPECT_EQ(pass(3.0), Texts{"choose a goal"});
  now_.menu_open = true;
  EXPECT_EQ(pass(60.0), Texts{});
  now_.menu_open = false;
  EXPECT_EQ(pass(3.0), Texts{"choose a goal"});
}

TEST_F(StateCuesTest, announces_the_arrival_again_to_who_begins_a_trial_at_its_goal) {
  under_way();
  now_.guidance->state = Guidance::State::arrived;
  pass(3.0);
  now_.trial = TrialState::State::ready;
  pass(3.0);
  now_.trial = TrialState::State::running;
  EXPECT_EQ(pass(3.0), (Texts{"go", "you have reached the goal"}));
}

TEST_F(StateCuesTest, says_why_a_goal_was_refused_once_a_goal) {
  under_way();
  now_.guidance->state = Guidance::State::goal_refused;
  now_.guidance->refusal = Guidance::Refusal::inside_obstacle;
  EXPECT_EQ(pass(60.0), Texts{"goal refused, the robot cannot stand there"});
  now_.guidance->goal = {3.0, 3.0};
  EXPECT_EQ(pass(60.0), Texts{"goal refused, the robot cannot stand there"});
  now_.guidance->refusal = Guidance::Refusal::unreachable;
  EXPECT_EQ(pass(60.0), Texts{"goal refused, it cannot be reached"});
}

TEST_F(StateCuesTest, says_nothing_of_a_state_or_a_wait_too_short_to_be_obeyed) {
  under_way();
  now_.guidance->state = Guidance::State::off_mesh;
  EXPECT_EQ(pass(0.3), Texts{});
  follow();
  EXPECT_EQ(pass(0.5), Texts{"drive straight, 20 meters"});
  now_.guidance->blocked_distance = 5.0;
  block();
  EXPECT_EQ(pass(0.3), Texts{});
  follow();
  EXPECT_EQ(pass(3.0), Texts{});
}

TEST_F(StateCuesTest, says_at_once_to_wait_for_what_would_be_reached_within_seconds) {
  under_way();
  block();
  now_.measured = navvi_types::Velocity{0.9, 0.0};
  now_.guidance->blocked_distance = 3.0;
  EXPECT_EQ(pass(0.3), Texts{});
  now_.guidance->blocked_distance = 2.0;
  EXPECT_EQ(pass(0.02), Texts{"wait, worker in the way"});
}

TEST_F(StateCuesTest, reminds_of_a_problem_that_lasts) {
  under_way();
  now_.guidance->state = Guidance::State::no_route;
  EXPECT_EQ(pass(31.0), Texts(3, "there is no route to the goal"));
}

}  // namespace
}  // namespace navvi_feedback::cues
