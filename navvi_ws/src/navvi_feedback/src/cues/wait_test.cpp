#include <gtest/gtest.h>

#include <functional>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

const Texts kWait = {"wait, worker in the way"};
const Texts kGoOn = {"go on, drive straight, 20 meters"};

/// Told to wait; then something happens, and then the way is free again.
class WaitTest : public CuePolicyTest {
 protected:
  WaitTest() {
    under_way();
    block();
    pass(1.0);
    stand();
  }
};

TEST_F(WaitTest, ends_by_go_on_and_the_new_route_where_that_is_another_one) {
  follow();
  now_.guidance->reroutes = 1;
  now_.guidance->reroute_reason = Guidance::Replan::waypoint_blocked;
  lead_to(0.0, -5.0, 1.6, 5.0);
  EXPECT_EQ(pass(5.0), Texts{"go on, way blocked, new route, 3 o'clock, 5 meters"});
}

TEST_F(WaitTest, ends_by_go_on_whatever_was_lost_or_wrong_meanwhile) {
  using State = Guidance::State;
  std::vector<std::pair<std::string, std::function<void()>>> rows;
  for (const State state : {State::no_route, State::off_mesh, State::pose_stale, State::map_stale})
    rows.emplace_back(to_string(state), [this, state] { now_.guidance->state = state; });
  const std::vector<std::pair<const char*, Link Links::*>> links = {
      {"guidance", &Links::guidance},
      {"pad", &Links::pad},
      {"simulator", &Links::simulator},
      {"proximity", &Links::proximity}};
  for (const auto& [name, link] : links)
    rows.emplace_back(name, [this, lost = link] { now_.links.*lost = Link::lost; });
  const Links alive = now_.links;
  for (const auto& [name, happens] : rows) {
    SCOPED_TRACE(name);
    block();
    pass(5.0);
    happens();
    pass(5.0);
    now_.links = alive;
    follow();
    EXPECT_EQ(pass(3.0).back(), kGoOn.front());
    pass(11.0);
  }
}

TEST_F(WaitTest, ends_by_go_on_with_the_new_goal_where_that_is_another_one) {
  now_.guidance->state = Guidance::State::arrived;
  pass(2.0);
  follow();
  now_.guidance->goal = {0.0, 7.0};
  lead_to(0.0, 7.0, 0.0, 3.0);
  now_.goal_angle = -1.6;
  EXPECT_EQ(pass(3.0),
            Texts{"go on, drive straight, 3 meters, the goal is 20 meters on, at 9 o'clock"});
}

TEST_F(WaitTest, ends_by_go_on_and_the_direction_where_ticks_lead_and_where_words_are_muted) {
  now_.lead = Lead::ticks;
  WordingConfig wording;
  wording.way = false;
  policy_.use(wording);
  follow();
  EXPECT_EQ(pass(10.0), kGoOn);
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
  const std::vector<CueStage> cut = {CueStage::queued, CueStage::started, CueStage::cut};
  for (const std::vector<CueStage>& lost : {cut, kDropped}) {
    follow();
    EXPECT_EQ(pass(3.0), kGoOn);
    note(7, lost);
    EXPECT_EQ(pass(3.0), kGoOn);
    note(8, kHeard);
    EXPECT_EQ(pass(0.5), Texts{});
    block();
    pass(5.0);
  }
}

TEST_F(WaitTest, owes_go_on_until_the_person_drives) {
  follow();
  std::uint32_t told = 0;
  for (double seconds = 0.0; seconds < 40.0; seconds += 0.1) {
    for (const std::string& text : pass(0.1)) {
      EXPECT_EQ(text, kGoOn.front());
      note(++told, kHeard);
    }
  }
  EXPECT_GE(told, 4U);
  EXPECT_LE(told, 8U);
  now_.commanded.linear = -1.0;
  now_.measured->linear = -0.3;
  pass(0.1);
  EXPECT_EQ(ask(Button::repeat), kGoOn) << "back is not on";
  note(++told, kHeard);
  now_.commanded.linear = 1.0;
  now_.measured->linear = 0.5;
  EXPECT_EQ(pass(12.0), Texts{});
  EXPECT_EQ(ask(Button::repeat), Texts{"drive straight, 20 meters"});
}

TEST_F(WaitTest, is_not_over_because_a_later_word_to_stop_was_not_heard) {
  note(1, {CueStage::started});
  pass(15.0);  // it is said again
  note(2, kDropped);
  follow();
  EXPECT_EQ(pass(3.0), kGoOn);
}

TEST_F(WaitTest, is_said_at_once_though_an_older_word_to_stop_holds) {
  note(1, {CueStage::queued, CueStage::started});
  now_.guidance->state = Guidance::State::no_route;
  pass(12.0);
  block();
  EXPECT_EQ(pass(0.6), kWait);
}

TEST_F(WaitTest, is_said_again_while_it_lasts_if_other_words_left_it_no_room) {
  for (int i = 1; i <= 3; ++i) {
    note(i, kDropped);
    EXPECT_EQ(pass(0.25), Texts{}) << "none that finds no room either";
    EXPECT_EQ(pass(0.25), kWait);
  }
  note(4, {CueStage::queued, CueStage::started});
  EXPECT_EQ(pass(2.0), Texts{});
  follow();
  EXPECT_EQ(pass(3.0), kGoOn);
}

TEST_F(WaitTest, is_said_again_if_it_found_no_room_in_the_moment_it_was_due) {
  const CueEvent due{1, CueStage::queued, Content(last_), last_.text, last_.priority};
  CueEvent gone = due;
  gone.stage = CueStage::dropped;
  CueEvent later = due;
  later.id = 2;
  policy_.note({due, later, gone});
  EXPECT_EQ(pass(1.0), Texts{}) << "a later one takes its place";
  note(2, {CueStage::dropped});
  EXPECT_EQ(pass(0.25), Texts{});
  EXPECT_EQ(pass(0.25), kWait);
}

TEST_F(WaitTest, is_neither_said_again_nor_taken_back_where_it_was_not_heard_and_the_way_is_free) {
  note(1, kDropped);
  follow();
  EXPECT_EQ(pass(3.0), Texts{});
}

TEST_F(WaitTest, ends_by_go_on_and_not_by_why_it_was_where_that_is_asked_just_then) {
  follow();
  Texts told;
  while (told.empty() || told == kWait) told = ask(Button::repeat, 0.02);
  EXPECT_EQ(told, kGoOn);
}

TEST_F(WaitTest, is_told_to_who_asks_only_when_its_reason_comes_back) {
  follow();
  EXPECT_EQ(pass(0.5), Texts{});
  EXPECT_EQ(ask(Button::repeat, 3.0), kGoOn) << "asked and answered once";
  block();
  pass(5.0);
  follow();
  pass(0.5);
  ask(Button::repeat);
  block();
  EXPECT_EQ(pass(0.1), kWait);
}

TEST_F(WaitTest, ends_by_an_answer_that_comes_before_go_on_was_heard) {
  follow();
  EXPECT_EQ(pass(3.0), kGoOn);
  EXPECT_EQ(ask(Button::repeat), kGoOn);
}

}  // namespace
}  // namespace navvi_feedback::cues
