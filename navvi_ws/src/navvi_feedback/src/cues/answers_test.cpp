#include "cues/answers.hpp"

#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

class AnswersTest : public CuePolicyTest {};

TEST_F(AnswersTest, answers_a_question_at_once) {
  under_way();
  now_.voice_busy = true;
  EXPECT_EQ(ask(Button::repeat), Texts{"drive straight, 20 meters"});
  EXPECT_EQ(last_.priority, Priority::message);
  now_.goal_angle = -1.6;
  EXPECT_EQ(ask(Button::goal), Texts{"the goal is 20 meters on, at 9 o'clock"});
  now_.guidance.reset();
  pass(3.0);
  EXPECT_EQ(ask(Button::goal), Texts{"there is no goal yet"});
}

TEST_F(AnswersTest, do_not_tell_the_way_a_third_time_within_seconds_so_that_a_person_can_drive) {
  under_way();
  std::size_t answers = 0;
  for (int second = 0; second < 12; ++second) {
    answers += ask(Button::repeat).size();
    pass(0.9);
  }
  EXPECT_EQ(answers, 4U);
  EXPECT_FALSE(ask(Button::goal).empty()) << "another question";
}

TEST_F(AnswersTest, C8_tell_no_way_while_the_emergency_stop_is_pressed) {
  for (const bool by_its_topic : {true, false}) {
    under_way();
    stand();
    now_.gate = DriveState::State::stopped;
    now_.notices = {CueKind::emergency_stop};
    if (by_its_topic) now_.devices.states = now_.notices;
    EXPECT_EQ(pass(15.0).size(), 2U) << "that, and that the robot was stopped";
    EXPECT_EQ(ask(Button::repeat, 3.0), Texts{"the emergency stop is pressed"});
    EXPECT_FALSE(policy_.leads()) << "nor does a sound lead";
    now_.gate = DriveState::State::running;
    now_.notices.clear();
    now_.devices.states.clear();
    EXPECT_EQ(ask(Button::repeat), Texts{"drive straight, 20 meters"});
    EXPECT_TRUE(policy_.leads());
  }
}

TEST_F(AnswersTest, tells_where_one_is_and_the_goal_from_there_in_one_frame) {
  under_way();
  now_.goal_angle = 1.6;
  now_.goal_straight = 12.0;
  EXPECT_EQ(ask(Button::where), Texts{"the goal is 12 meters, 3 o'clock, as the crow flies"});
  now_.place = navvi_types::Place{navvi_types::Place::Kind::aisle, 3};
  EXPECT_EQ(ask(Button::where), Texts{"aisle 3, goal 12 meters 3 o'clock, as the crow flies"});
  now_.guidance->state = Guidance::State::arrived;
  pass(3.0);
  EXPECT_EQ(ask(Button::where), Texts{"aisle 3"});
  now_.place.reset();
  EXPECT_EQ(ask(Button::where), Texts{"you have reached the goal"});
}

TEST_F(AnswersTest, tells_the_next_turn) {
  under_way();
  EXPECT_EQ(ask(Button::turn), Texts{"drive straight, 20 meters"}) << "none before the goal";
  now_.guidance->waypoint_is_goal = false;
  now_.guidance->turn_angle = 1.6;
  now_.guidance->waypoint_distance = 18.0;
  EXPECT_EQ(ask(Button::turn), Texts{"in 18 meters, turn to 3 o'clock"});
}

TEST_F(AnswersTest, tells_what_is_around_clockwise_from_the_nearest) {
  now_.guidance.reset();
  EXPECT_EQ(ask(Button::around), Texts{"nothing is near"});
  now_.nearby = {{ThingClass::wall, 1, 0.5, {0.0, 0.9}, false},
                 {ThingClass::worker, 2, 1.0, {-1.4, 0.0}, true},
                 {ThingClass::shelf, 3, 1.1, {0.0, -1.5}, false},
                 {ThingClass::box, 4, 1.2, {0.2, -1.6}, false},
                 {ThingClass::forklift, 5, 2.9, {3.3, 0.0}, true},
                 {ThingClass::pallet_robot, 6, 3.1, {0.0, 3.5}, true}};
  EXPECT_EQ(ask(Button::around, 0.02),
            Texts{"wall 0.5 meters left, forklift ahead, shelf 1 meter right, worker 1 meter "
                  "behind"})
      << "four sides with their distances are too long to be spoken at once";
  ASSERT_EQ(last_.scan.size(), 4U);
  EXPECT_EQ(last_.scan[1].earcon, sounds::Earcon::forklift_near);
  EXPECT_EQ(last_.scan[1].from, Eigen::Vector2d(3.3, 0.0));
  now_.nearby = {{ThingClass::forklift, 5, 2.0, {-2.4, 0.0}, true},
                 {ThingClass::shelf, 3, 1.1, {0.0, 1.5}, false}};
  EXPECT_EQ(ask(Button::around), Texts{"shelf 1 meter left, forklift 2 meters behind"});
}

TEST_F(AnswersTest, tells_what_is_around_also_of_a_thing_that_is_touched) {
  for (const double gap : {0.0, -0.004, -0.3}) {
    now_.nearby = {{ThingClass::shelf, 1, gap, {0.4, 0.0}, false}};
    EXPECT_EQ(ask(Button::around, 1.0).at(0), "shelf 0.5 meters ahead") << gap;
  }
}

TEST_F(AnswersTest, T3_tell_that_the_robot_is_silent_and_not_that_there_is_no_goal) {
  under_way();
  now_.links.simulator = now_.links.guidance = Link::lost;
  pass(8.0);
  for (const Button question : {Button::repeat, Button::goal, Button::turn})
    EXPECT_EQ(ask(question, 4.0), Texts{"the robot does not report its motion"});
  now_.cut_off = true;
  EXPECT_EQ(ask(Button::repeat, 4.0), Texts{"connection lost"});
}

TEST_F(AnswersTest, T3_tell_that_the_robot_is_silent_and_not_what_a_job_waited_for) {
  now_.guidance->state = Guidance::State::no_goal;
  now_.trial = TrialState::State::ready;
  now_.task = TrialState::Task::pick;
  now_.reached = "dock";
  EXPECT_EQ(pass(3.0), Texts{"dock, pick, then press start"});
  now_.links.simulator = Link::lost;
  pass(3.0);
  now_.trial = TrialState::State::preparing;
  now_.reached.clear();
  EXPECT_EQ(ask(Button::repeat), Texts{"the robot does not report its motion"});
}

TEST_F(AnswersTest, do_not_say_that_nothing_is_near_where_that_is_not_known) {
  under_way();
  now_.links.proximity = Link::lost;
  pass(3.0);
  EXPECT_EQ(ask(Button::around), Texts{"obstacles are not sensed"});
  now_.links.proximity = Link::alive;
  pass(3.0);
  EXPECT_EQ(ask(Button::around), Texts{"nothing is near"});
}

TEST_F(AnswersTest, tells_over_a_delay_before_what_the_robot_stops) {
  now_.nearby = {{ThingClass::box, 1, 0.4, {0.3, 0.8}, false},
                 {ThingClass::shelf, 2, 1.2, {1.6, 0.1}, false}};
  now_.measured = Velocity{0.2, 0.0};
  now_.stops_in = 0.2;
  const auto ask_around = [&] { return ask(Button::around, 1.0).at(0); };
  EXPECT_EQ(ask_around().substr(0, 3), "box");
  now_.connection.foresight = 0.5;
  EXPECT_EQ(ask_around(), "you stop 1 meter before shelf");
  now_.stops_in = -0.2;
  EXPECT_EQ(ask_around().substr(0, 3), "box") << "nothing is behind";
  now_.measured = Velocity{};
  now_.stops_in = 0.0;
  EXPECT_EQ(ask_around().substr(0, 3), "box") << "it stands";
}

TEST_F(AnswersTest, does_not_say_that_there_is_no_goal_while_a_path_may_be_on_its_way) {
  now_.guidance.reset();
  EXPECT_EQ(ask(Button::repeat, 4.0), Texts{});
}

TEST_F(AnswersTest, an_answer_that_was_heard_is_not_given_again_for_a_later_cue_that_was_dropped) {
  under_way();
  block();
  pass(1.0);
  ask(Button::repeat);
  note(2, {CueStage::started});
  note(3, {CueStage::dropped});
  EXPECT_EQ(pass(0.1), Texts{});
}

}  // namespace
}  // namespace navvi_feedback::cues
