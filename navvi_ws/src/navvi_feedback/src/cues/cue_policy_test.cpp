#include "cues/cue_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "cue_policy_fixture.hpp"

namespace navvi_feedback::cues {
namespace {

TEST_F(CuePolicyTest, says_nothing_before_anything_is_known) {
  now_ = Observation();
  EXPECT_EQ(pass(5.0), Texts{});
}

TEST_F(CuePolicyTest, says_what_to_do_first_and_then_where_the_goal_is) {
  now_.goal_angle = 1.6;
  EXPECT_EQ(pass(1.0), (Texts{"drive straight, 20 meters",
                              "the goal is 20 meters along the path, at 3 o'clock"}));
}

TEST_F(CuePolicyTest, tells_one_direction_of_a_goal_whether_it_is_asked_for_or_not) {
  for (const double angle : {-0.5, 0.2, 0.7, 2.5}) {
    now_.goal_angle = angle;
    now_.guidance->goal.x() += 5.0;
    const auto of = [](const std::string& text) { return text.substr(text.rfind(',')); };
    const std::string unasked = of(pass(1.0).back());
    EXPECT_EQ(of(ask(Button::goal, 0.02).front()), unasked);
    EXPECT_NE(unasked, "");
    pass(5.0);
  }
}

TEST_F(CuePolicyTest, says_not_to_drive_at_what_moves_ahead_where_ticks_lead) {
  now_.lead = Lead::ticks;
  now_.guidance->waypoint_is_goal = false;
  pass(1.0);
  drive(1.0);
  lead_to(30.0, 0.0, 0.0, 0.5);
  pass(1.0);
  lead_to(30.0, 20.0, 0.0, 20.0);
  now_.nearby = {{ThingClass::forklift, 5, 2.0, {2.4, 0.0}, true}};
  EXPECT_EQ(pass(1.0), Texts{});
  now_.nearby.clear();
  EXPECT_EQ(pass(0.5), Texts{"drive straight, 20 meters"});
}

TEST_F(CuePolicyTest, says_once_more_that_the_route_is_new_if_that_was_cut) {
  under_way();
  lead_to(0.0, 5.0, -M_PI / 2.0, 5.0);
  now_.guidance->reroutes = 1;
  EXPECT_EQ(pass(1.0), Texts{"new route, 9 o'clock, 5 meters"});
  note(1, {CueStage::started});
  EXPECT_EQ(pass(0.5), Texts{});
  note(1, {CueStage::cut});
  EXPECT_EQ(pass(0.5), Texts{"new route, 9 o'clock, 5 meters"});
}

TEST_F(CuePolicyTest, mutes_what_a_person_does_without_but_no_safety_phrase_and_no_answer) {
  WordingConfig wording;
  wording.way = wording.near = false;
  policy_.use(wording);
  now_.goal_angle = 0.0;
  pass(1.0);
  drive(0.3);
  now_.nearby = {{ThingClass::shelf, 1, 0.8, {0.5, 1.0}}};
  EXPECT_EQ(pass(5.0), Texts{});
  drive(1.0);
  Texts approach;
  for (double gap = 2.0; gap > 0.5; gap -= 0.1) {
    now_.nearby = {{ThingClass::shelf, 1, gap, {gap + 0.4, 0.0}}};
    for (const std::string& text : pass(0.1)) approach.push_back(text);
  }
  EXPECT_EQ(approach, Texts{"stop, shelf ahead"});
  now_.nearby.clear();
  now_.measured->linear = 0.0;
  const std::string go_on = pass(5.0).front();
  EXPECT_EQ(go_on, "go on, drive straight, 20 meters");
  for (const CueStage stage : kHeard) policy_.note({{9, stage, CueKind::straight, go_on}});
  now_.measured->linear = 1.0;
  EXPECT_EQ(pass(0.5), Texts{});
  EXPECT_EQ(ask(Button::repeat), Texts{"drive straight, 20 meters"});
}

TEST_F(CuePolicyTest, repeats_to_who_stands_what_to_do_and_not_what_was_said) {
  Texts told = pass(60.0);
  ASSERT_GE(told.size(), 6U);
  EXPECT_EQ(told.front(), "drive straight, 20 meters");
  told.erase(told.begin(), told.begin() + 2);
  for (const std::string& text : told) EXPECT_EQ(text, "push the stick forward");
}

TEST_F(CuePolicyTest, words_things_otherwise_as_soon_as_it_is_wanted) {
  under_way();
  WordingConfig wording;
  wording.verbosity = "brief";
  policy_.use(wording);
  EXPECT_EQ(ask(Button::repeat), Texts{"straight"});
}

TEST_F(CuePolicyTest, speaks_of_what_is_near_before_there_is_a_goal_only_while_the_robot_moves) {
  now_.guidance.reset();
  now_.nearby = {{ThingClass::shelf, 1, 0.5, {0.0, 0.9}, false}};
  EXPECT_EQ(pass(3.0), Texts{});
  now_.commanded.angular = now_.measured->angular = 0.5;
  EXPECT_EQ(pass(1.0), Texts{"shelf on your left"});
}

TEST_F(CuePolicyTest, asks_to_release_a_stick_that_is_held_in_vain_and_then_says_the_way) {
  under_way();
  stand();
  now_.stick_held_unarmed = true;
  const Texts held = pass(5.0);
  EXPECT_EQ(std::count(held.begin(), held.end(), "release the stick"), 2);
  EXPECT_EQ(policy_.order().value().kind, CueKind::release_stick) << "as long as it is held";
  now_.stick_held_unarmed = false;
  EXPECT_EQ(pass(3.0), Texts{"drive straight, 20 meters"});
}

TEST_F(CuePolicyTest, orders_nothing_but_the_remedy_while_the_stick_is_held_in_vain) {
  using Hold = std::function<void(bool)>;
  const auto against = [this](DriveState::State gate) {
    return [this, gate](bool held) {
      now_.gate = held ? gate : DriveState::State::running;
      now_.commanded.linear = held ? 1.0 : 0.0;
    };
  };
  const std::vector<std::pair<Hold, std::string>> holds = {
      {[this](bool held) { now_.stick_held_unarmed = held; }, "release the keys"},
      {[this](bool held) { now_.stick_disabled = held; },
       "hold the drive button, then push the stick"},
      {against(DriveState::State::waiting), "release the keys"},
      {against(DriveState::State::stopped), "release the keys"}};
  now_.devices.keyboard = true;
  under_way();
  stand();
  for (const auto& [hold, remedy] : holds) {
    hold(true);
    pass(1.0);
    std::set<std::string> told;
    const auto hear = [&](double seconds) {
      for (const std::string& text : pass(seconds)) told.insert(text);
    };
    hear(30.0);
    asked_.question = Button::repeat;
    hear(1.0);
    ++now_.guidance->reroutes;
    now_.guidance->waypoint.y() += 5.0;
    now_.guidance->waypoint_angle = now_.guidance->steer_angle -= 0.8;
    hear(15.0);
    EXPECT_EQ(told, std::set<std::string>{remedy});
    now_.guidance->state = Guidance::State::blocked;
    pass(5.0);
    now_.guidance->state = Guidance::State::following;
    told.clear();
    hear(15.0);
    EXPECT_EQ(told, std::set<std::string>{remedy}) << "nor to go on";
    hold(false);
    const Texts on = pass(5.0);
    ASSERT_FALSE(on.empty()) << remedy;
    EXPECT_EQ(on.front().substr(0, 7), "go on, ");
    note(9, kHeard);
    drive(1.0);
    pass(5.0);
    stand();
  }
}

TEST_F(CuePolicyTest, may_say_again_at_once_what_was_dropped) {
  under_way();
  const auto stop_once_more = [&] {
    now_.gate = DriveState::State::running;
    pass(0.1);
    now_.gate = DriveState::State::stopped;
    return pass(0.4);
  };
  EXPECT_EQ(stop_once_more(), Texts{"robot stopped, release the stick"});
  const Cue stopped = last_;
  EXPECT_EQ(stop_once_more(), Texts{});
  last_ = stopped;
  note(1, {CueStage::dropped});
  EXPECT_EQ(stop_once_more(), Texts{"robot stopped, release the stick"});
}

TEST_F(CuePolicyTest, N7_does_not_chatter_on_a_quiet_drive) {
  under_way();
  EXPECT_LE(pass(60.0).size(), 8U);
}

TEST_F(CuePolicyTest, orders_what_the_voice_says_and_nothing_that_it_drops_or_cuts) {
  using Stage = navvi_types::CueStage;
  const auto note = [&](Stage stage) {
    policy_.note({{7, stage, CueKind::back_away, "back away, box ahead", Priority::message}});
    return policy_.order().value().text;
  };
  under_way();
  now_.nearby = {{ThingClass::box, 1, 0.15, {0.5, 0.0}, false}};
  now_.measured->linear = 0.0;
  ASSERT_EQ(pass(1.6), Texts{"back away, box ahead"});
  now_.nearby.clear();
  now_.measured->linear = 1.0;
  note(Stage::queued);
  EXPECT_EQ(note(Stage::dropped), "straight");
  EXPECT_EQ(note(Stage::started), "back away, box ahead");
  EXPECT_EQ(note(Stage::ended), "back away, box ahead");
  pass(5.0);
  EXPECT_EQ(note(Stage::started), "back away, box ahead") << "once more, after it had ended";
  EXPECT_EQ(note(Stage::cut), "straight");
  note(Stage::started);
  policy_.note({{8, Stage::started, CueKind::straight, "go on", Priority::message}});
  EXPECT_EQ(policy_.order().value().text, "straight") << "the voice says something else";
}

}  // namespace
}  // namespace navvi_feedback::cues
