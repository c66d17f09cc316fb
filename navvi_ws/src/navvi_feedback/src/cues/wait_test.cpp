#include <gtest/gtest.h>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

/// Told to wait; then something happens, and then the way is free again.
class WaitTest : public CuePolicyTest {
 protected:
  WaitTest() {
    under_way();
    now_.guidance->state = Guidance::State::blocked;
    now_.guidance->blocked_by = ThingClass::worker;
    pass(1.0);
    now_.commanded = {};
    now_.measured = Velocity{};
  }
  void follow() { now_.guidance->state = Guidance::State::following; }
  void note(std::uint32_t id, CueStage stage) {
    policy_.note({{id, stage, last_.kind, last_.text, last_.priority}});
  }
};

TEST_F(WaitTest, ends_by_go_on_and_the_new_route_where_that_is_another_one) {
  follow();
  now_.guidance->reroutes = 1;
  now_.guidance->reroute_reason = Guidance::Replan::waypoint_blocked;
  now_.guidance->waypoint = {0.0, -5.0};
  now_.guidance->waypoint_angle = now_.guidance->steer_angle = 1.6;
  now_.guidance->waypoint_distance = 5.0;
  EXPECT_EQ(pass(5.0), Texts{"go on, way blocked, new route, 3 o'clock, 5 meters"});
}

TEST_F(WaitTest, ends_by_go_on_whichever_link_was_lost_meanwhile) {
  for (Link Links::*link : {&Links::guidance, &Links::pad, &Links::simulator, &Links::proximity}) {
    now_.guidance->state = Guidance::State::blocked;
    pass(5.0);
    now_.links.*link = Link::lost;
    pass(5.0);
    now_.links.*link = Link::alive;
    follow();
    EXPECT_EQ(pass(3.0).back(), "go on, drive straight, 20 meters");
    pass(11.0);
  }
}

TEST_F(WaitTest, ends_by_go_on_after_any_state_in_which_nothing_leads) {
  for (const auto state : {Guidance::State::no_route, Guidance::State::off_mesh,
                           Guidance::State::pose_stale, Guidance::State::map_stale}) {
    now_.guidance->state = Guidance::State::blocked;
    pass(5.0);
    now_.guidance->state = state;
    pass(5.0);
    follow();
    EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"}) << to_string(state);
    pass(11.0);
  }
}

TEST_F(WaitTest, ends_by_go_on_with_the_new_goal_where_that_is_another_one) {
  now_.guidance->state = Guidance::State::arrived;
  pass(2.0);
  follow();
  now_.guidance->goal = now_.guidance->waypoint = {0.0, 7.0};
  now_.goal_angle = -1.6;
  now_.guidance->waypoint_distance = 3.0;
  EXPECT_EQ(pass(3.0),
            Texts{"go on, drive straight, 3 meters, the goal is 20 meters on, at 9 o'clock"});
}

TEST_F(WaitTest, ends_by_go_on_and_the_direction_where_ticks_lead_and_where_words_are_muted) {
  now_.lead = Lead::ticks;
  WordingConfig wording;
  wording.way = false;
  policy_.use(wording);
  follow();
  EXPECT_EQ(pass(10.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(WaitTest, is_not_shown_for_long_when_its_goal_is_gone) {
  now_.guidance->state = Guidance::State::arrived;
  pass(1.0);
  EXPECT_EQ(policy_.order().value().kind, CueKind::arrived);
  now_.guidance->state = Guidance::State::no_goal;
  pass(5.0);
  EXPECT_FALSE(policy_.order()) << policy_.order()->text;
  follow();
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters, the goal is 20 meters on"});
}

TEST_F(WaitTest, is_not_over_before_go_on_was_heard_to_its_end) {
  for (const CueStage lost : {CueStage::cut, CueStage::dropped}) {
    follow();
    EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
    note(7, CueStage::queued);
    if (lost == CueStage::cut) note(7, CueStage::started);
    note(7, lost);
    EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
    note(8, CueStage::queued);
    note(8, CueStage::started);
    note(8, CueStage::ended);
    EXPECT_EQ(pass(0.5), Texts{});
    now_.guidance->state = Guidance::State::blocked;
    pass(5.0);
  }
}

TEST_F(WaitTest, owes_go_on_until_the_person_drives) {
  follow();
  const std::string go_on = "go on, drive straight, 20 meters";
  std::uint32_t id = 0;
  int told = 0;
  for (double seconds = 0.0; seconds < 40.0; seconds += 0.1) {
    for (const std::string& text : pass(0.1)) {
      EXPECT_EQ(text, go_on);
      ++told;
      ++id;
      for (const CueStage stage : {CueStage::queued, CueStage::started, CueStage::ended})
        note(id, stage);
    }
  }
  EXPECT_GE(told, 4);
  EXPECT_LE(told, 8);
  now_.commanded.linear = -1.0;
  now_.measured->linear = -0.3;
  pass(0.1);
  asked_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{go_on}) << "back is not on";
  ++id;
  for (const CueStage stage : {CueStage::queued, CueStage::started, CueStage::ended})
    note(id, stage);
  now_.commanded.linear = 1.0;
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(12.0), Texts{});
  asked_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{"drive straight, 20 meters"});
}

TEST_F(WaitTest, is_not_over_because_a_later_word_to_stop_was_not_heard) {
  note(1, CueStage::started);
  pass(15.0);  // it is said again
  note(2, CueStage::queued);
  note(2, CueStage::dropped);
  follow();
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(WaitTest, is_said_at_once_though_an_older_word_to_stop_holds) {
  note(1, CueStage::queued);
  note(1, CueStage::started);
  now_.guidance->state = Guidance::State::no_route;
  pass(12.0);
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(0.6), Texts{"wait, worker in the way"});
}

TEST_F(WaitTest, is_said_again_while_it_lasts_if_other_words_left_it_no_room) {
  for (int i = 1; i <= 3; ++i) {
    note(i, CueStage::queued);
    note(i, CueStage::dropped);
    EXPECT_EQ(pass(0.25), Texts{}) << "none that finds no room either";
    EXPECT_EQ(pass(0.25), Texts{"wait, worker in the way"});
  }
  note(4, CueStage::queued);
  note(4, CueStage::started);
  EXPECT_EQ(pass(2.0), Texts{});
  follow();
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(WaitTest, is_said_again_if_it_found_no_room_in_the_moment_it_was_due) {
  const CueEvent due{1, CueStage::queued, Content(last_), last_.text, last_.priority};
  CueEvent gone = due;
  gone.stage = CueStage::dropped;
  CueEvent later = due;
  later.id = 2;
  policy_.note({due, later, gone});
  EXPECT_EQ(pass(1.0), Texts{}) << "a later one takes its place";
  later.stage = CueStage::dropped;
  policy_.note({later});
  EXPECT_EQ(pass(0.25), Texts{});
  EXPECT_EQ(pass(0.25), Texts{"wait, worker in the way"});
}

TEST_F(WaitTest, is_not_said_again_once_the_way_is_free) {
  note(1, CueStage::queued);
  note(1, CueStage::dropped);
  follow();
  EXPECT_EQ(pass(3.0), Texts{});
}

TEST_F(WaitTest, ends_by_go_on_and_not_by_why_it_was_where_that_is_asked_just_then) {
  follow();
  Texts told;
  while (told.empty()) {
    asked_.question = Question::way;
    const Texts more = pass(0.02);
    if (more != Texts{"wait, worker in the way"}) told = more;
  }
  EXPECT_EQ(told, Texts{"go on, drive straight, 20 meters"});
}

TEST_F(WaitTest, is_not_told_again_to_who_asks_when_its_reason_is_gone) {
  follow();
  EXPECT_EQ(pass(0.5), Texts{});
  asked_.question = Question::way;
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"}) << "asked and answered once";
}

TEST_F(WaitTest, is_told_to_who_asks_when_its_reason_comes_back) {
  follow();
  pass(0.5);
  asked_.question = Question::way;
  pass(0.1);
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(0.1), Texts{"wait, worker in the way"});
}

TEST_F(WaitTest, ends_by_an_answer_that_comes_before_go_on_was_heard) {
  follow();
  EXPECT_EQ(pass(3.0), Texts{"go on, drive straight, 20 meters"});
  asked_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{"go on, drive straight, 20 meters"});
}

TEST_F(WaitTest, is_followed_by_a_stop_1_5_s_before_the_shelf_at_the_speed_driven) {
  follow();
  double gap = 0.6;
  const auto see = [&] { now_.nearby = {{ThingClass::shelf, 3, gap, {gap + 0.35, 0.0}, false}}; };
  see();
  pass(4.0);
  Texts told;
  for (double speed = 0.0; gap > 0.0 && told.empty(); gap -= 0.02 * speed) {
    speed = std::min(0.9, speed + 0.02 * 1.2);
    now_.commanded.linear = now_.measured->linear = speed;
    see();
    told = pass(0.02);
    if (!told.empty()) {
      EXPECT_GE(gap / speed, 1.5);
    }
  }
  EXPECT_EQ(told, Texts{"stop, shelf ahead"});
}

}  // namespace
}  // namespace navvi_feedback::cues
