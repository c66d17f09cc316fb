#include "cues/cue_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <navvi_config/reader.hpp>
#include <random>

namespace navvi_feedback::cues {
namespace {

const std::string kEnglish = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml";

using Texts = std::vector<std::string>;

class CuePolicyTest : public testing::Test {
 protected:
  CuePolicyTest() {
    now_.links.pad = now_.links.simulator = Link::alive;
    now_.links.guidance = now_.links.proximity = now_.links.audio = Link::alive;
    now_.gate = DriveState::State::running;
    now_.measured.emplace();
    now_.guidance.emplace();
    now_.guidance->state = Guidance::State::following;
    now_.guidance->goal = {20.0, 0.0};
    now_.guidance->waypoint = {20.0, 0.0};
    now_.guidance->waypoint_is_goal = true;
    now_.guidance->waypoint_distance = now_.guidance->goal_distance = 20.0;
  }

  Texts pass(double seconds) {
    Texts texts;
    for (const double end = time_ + seconds; time_ < end - 1e-9; time_ += 0.02) {
      for (const Cue& cue : policy_.update(now_, time_)) {
        texts.push_back(cue.text);
        last_ = cue;
      }
      now_.contacts.clear();
      now_.question.reset();
    }
    return texts;
  }

  /// Drives ahead until only news is said.
  void under_way() {
    now_.commanded.linear = now_.measured->linear = 1.0;
    pass(3.0);
  }

  CuePolicy policy_{CuePolicyConfig{}, Phrases(kEnglish)};
  Situation now_;
  Cue last_;
  double time_ = 50.0;
};

TEST(CuePolicyConfig, refuses_what_it_does_not_know) {
  CuePolicyConfig config;
  for (const char* text : {"stuck_time: -1", "route: {rounding: up}", "near: {distance: .nan}",
                           "wording: {directions: compass}", "chatter: 1"})
    EXPECT_THROW(navvi_config::read(config, YAML::Load(text), "test"), navvi_config::ConfigError)
        << text;
}

TEST(CuePolicyConfig, floors_the_hours_in_the_papers_profile) {
  const std::string file = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/paper.yaml";
  CuePolicyConfig config;
  navvi_config::read(config, navvi_config::load_yaml(file)["cues"], file);
  EXPECT_EQ(config.route.rounding, "floor");
  EXPECT_FALSE(config.near.obstacles);
}

TEST_F(CuePolicyTest, says_nothing_before_anything_is_known) {
  now_ = Situation();
  EXPECT_EQ(pass(5.0), Texts{});
}

TEST_F(CuePolicyTest, says_which_messages_never_came) {
  now_ = Situation();
  pass(9.0);
  EXPECT_EQ(pass(2.0), (Texts{"controller disconnected", "simulator lost"}));
}

TEST_F(CuePolicyTest, introduces_the_goal_then_the_way) {
  now_.goal_angle = 1.6;
  EXPECT_EQ(pass(1.0), (Texts{"Ready. Goal 20 meters, 3 o'clock", "straight ahead, 20 meters"}));
}

TEST_F(CuePolicyTest, announces_the_arrival_once) {
  under_way();
  now_.guidance->state = Guidance::State::arrived;
  EXPECT_EQ(pass(60.0), Texts{"You have reached your destination"});
  now_.links.guidance = Link::lost;
  pass(2.0);
  now_.links.guidance = Link::alive;
  EXPECT_EQ(pass(2.0), Texts{});
}

TEST_F(CuePolicyTest, says_why_a_goal_was_refused_once_a_goal) {
  under_way();
  now_.guidance->state = Guidance::State::goal_refused;
  now_.guidance->refusal = Guidance::Refusal::inside_obstacle;
  EXPECT_EQ(pass(60.0), Texts{"goal refused, something stands there"});
  now_.guidance->goal = {3.0, 3.0};
  EXPECT_EQ(pass(60.0), Texts{"goal refused, something stands there"});
  now_.guidance->refusal = Guidance::Refusal::unreachable;
  EXPECT_EQ(pass(60.0), Texts{"goal refused, it cannot be reached"});
}

TEST_F(CuePolicyTest, passes_over_a_state_that_lasts_no_time) {
  under_way();
  now_.guidance->state = Guidance::State::off_mesh;
  EXPECT_EQ(pass(0.3), Texts{});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(0.5), Texts{"straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, says_to_wait_for_what_is_in_the_way_and_then_to_go_on) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::forklift;
  EXPECT_EQ(pass(5.0), Texts{"wait, forklift in the way"});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(1.0), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, holds_a_wait_until_a_person_can_have_obeyed_it) {
  under_way();
  now_.guidance->blocked_distance = 5.0;
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  EXPECT_EQ(pass(0.6), Texts{"wait, worker in the way"});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(1.5), Texts{}) << "the way is clear, but they have only just let go";
  EXPECT_EQ(pass(1.0), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, holds_a_wait_that_was_asked_for_again_but_not_for_ever) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  pass(1.0);
  const auto heard = [&] { policy_.note({{1, CueStage::started, last_.kind, last_.text}}); };
  heard();
  now_.guidance->state = Guidance::State::following;
  pass(1.0);
  now_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{"wait, worker in the way"});
  heard();
  EXPECT_EQ(pass(1.8), Texts{}) << "what was just called in the way";
  EXPECT_EQ(pass(0.4), Texts{"go on, straight ahead, 20 meters"});

  now_.guidance->state = Guidance::State::blocked;
  pass(5.0);
  now_.guidance->state = Guidance::State::following;
  heard();
  for (int i = 0; i < 12 && last_.kind == CueKind::blocked; ++i) {
    now_.question = Question::way;
    pass(1.0);
    heard();
  }
  EXPECT_EQ(last_.kind, CueKind::straight);
}

TEST_F(CuePolicyTest, says_go_on_to_nobody_whom_something_will_reach_but_not_for_ever) {
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
  EXPECT_EQ(comes_for(3.5), Texts{"forklift coming, on the left"});
  now_.nearby.clear();
  EXPECT_EQ(pass(1.0), Texts{"go on, straight ahead, 20 meters"}) << "it has passed";

  now_.guidance->state = Guidance::State::blocked;
  pass(1.0);
  now_.guidance->state = Guidance::State::following;
  Texts told;
  for (int i = 0; i < 5 && told.empty(); ++i) {
    now_.nearby.clear();  // one after another
    told = comes_for(2.0);
  }
  EXPECT_EQ(told, Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, says_not_to_drive_at_what_moves_ahead_where_ticks_lead) {
  now_.sounds.turn = true;
  now_.guidance->waypoint_is_goal = false;
  pass(1.0);
  now_.commanded.linear = now_.measured->linear = 1.0;
  now_.guidance->waypoint = {30.0, 0.0};
  now_.guidance->waypoint_distance = 0.5;
  pass(1.0);
  now_.guidance->waypoint = {30.0, 20.0};
  now_.guidance->waypoint_distance = 20.0;
  now_.nearby = {{ThingClass::forklift, 5, 2.0, {2.4, 0.0}, true}};
  EXPECT_EQ(pass(1.0), Texts{});
  now_.nearby.clear();
  EXPECT_EQ(pass(0.5), Texts{"straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, says_the_same_once_more_in_other_words) {
  under_way();
  now_.sounds.turn = true;
  now_.guidance->blocked_distance = 5.0;
  now_.guidance->blocked_by = ThingClass::worker;
  Texts said;
  for (int i = 0; i < 2; ++i) {
    now_.guidance->state = Guidance::State::blocked;
    for (const std::string& text : pass(1.0)) said.push_back(text);
    now_.guidance->state = Guidance::State::following;
    for (const std::string& text : pass(3.0)) said.push_back(text);
  }
  EXPECT_EQ(said, (Texts{"wait, worker in the way", "go on, straight ahead, 20 meters",
                         "wait again, worker", "go on, straight ahead, 20 meters"}));
  pass(10.0);
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(1.0), Texts{"wait, worker in the way"}) << "that is long ago";
}

TEST_F(CuePolicyTest, says_nothing_of_a_wait_too_short_to_be_obeyed) {
  under_way();
  now_.guidance->blocked_distance = 5.0;
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(0.3), Texts{});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(3.0), Texts{});
}

TEST_F(CuePolicyTest, says_at_once_to_wait_for_what_would_be_reached_within_seconds) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  now_.measured = navvi_types::Velocity{0.9, 0.0};
  now_.guidance->blocked_distance = 3.0;
  EXPECT_EQ(pass(0.3), Texts{});
  now_.guidance->blocked_distance = 2.0;
  EXPECT_EQ(pass(0.02), Texts{"wait, worker in the way"});
}

TEST_F(CuePolicyTest, ends_a_wait_by_the_word_to_make_room) {
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
  EXPECT_EQ(pass(2.0), Texts{"go on, make room for a forklift, 6 o'clock, 3 meters"});
}

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
    EXPECT_EQ(pass(3.0).back(), "go on, straight ahead, 20 meters");
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
    EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 20 meters"}) << to_string(state);
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
  EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 3 meters, goal 20 meters, 9 o'clock"});
}

TEST_F(WaitTest, ends_by_go_on_and_the_direction_where_ticks_lead_and_where_words_are_muted) {
  now_.sounds.turn = true;
  WordingConfig wording;
  wording.way = false;
  policy_.use(wording);
  follow();
  EXPECT_EQ(pass(10.0), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(WaitTest, is_not_over_before_go_on_was_heard_to_its_end) {
  for (const CueStage lost : {CueStage::cut, CueStage::dropped}) {
    follow();
    EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 20 meters"});
    note(7, CueStage::queued);
    if (lost == CueStage::cut) note(7, CueStage::started);
    note(7, lost);
    EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 20 meters"});
    note(8, CueStage::queued);
    note(8, CueStage::started);
    note(8, CueStage::ended);
    EXPECT_EQ(pass(3.0), Texts{});
    now_.guidance->state = Guidance::State::blocked;
    pass(5.0);
  }
}

TEST_F(WaitTest, is_not_over_because_a_later_word_to_stop_was_not_heard) {
  note(1, CueStage::started);
  pass(15.0);  // it is said again
  note(2, CueStage::queued);
  note(2, CueStage::dropped);
  follow();
  EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(WaitTest, ends_by_go_on_and_not_by_why_it_was_where_that_is_asked_just_then) {
  follow();
  Texts told;
  while (told.empty()) {
    now_.question = Question::way;
    const Texts more = pass(0.02);
    if (more != Texts{"wait, worker in the way"}) told = more;
  }
  EXPECT_EQ(told, Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(WaitTest, ends_by_an_answer_that_comes_before_go_on_was_heard) {
  follow();
  EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 20 meters"});
  now_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, an_answer_to_wait_is_a_wait_that_ends_by_go_on) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::worker;
  now_.guidance->blocked_distance = 5.0;
  now_.question = Question::way;
  EXPECT_EQ(pass(0.2), Texts{"wait, worker in the way"});
  now_.guidance->state = Guidance::State::following;
  EXPECT_EQ(pass(3.0), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, says_go_on_to_nobody_who_would_meet_what_moves_on_the_way) {
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
  EXPECT_EQ(told, Texts{"go on, straight ahead, 20 meters"});
  EXPECT_LT(y, 2.0) << "it will be past";
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

TEST_F(CuePolicyTest, takes_back_no_wait_that_was_never_heard) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  EXPECT_EQ(pass(0.6).size(), 1U);
  policy_.note({{1, CueStage::dropped, last_.kind, last_.text}});
  now_.guidance->state = Guidance::State::following;
  for (const std::string& text : pass(3.0)) EXPECT_EQ(text.find("go on"), std::string::npos);
}

TEST_F(CuePolicyTest, a_question_during_a_wait_is_answered_by_it_however_often) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::forklift;
  pass(1.0);
  for (int i = 0; i < 3; ++i) {
    now_.question = Question::way;
    EXPECT_EQ(pass(0.5), Texts{"wait, forklift in the way"});
  }
}

TEST_F(CuePolicyTest,
       an_answer_that_was_heard_is_not_given_again_for_a_later_cue_that_was_dropped) {
  under_way();
  now_.guidance->state = Guidance::State::blocked;
  now_.guidance->blocked_by = ThingClass::forklift;
  pass(1.0);
  now_.question = Question::way;
  pass(0.1);
  policy_.note({{2, CueStage::started, last_.kind, last_.text}});
  policy_.note({{3, CueStage::dropped, last_.kind, last_.text}});
  EXPECT_EQ(pass(0.1), Texts{});
}

TEST_F(CuePolicyTest, nothing_cuts_the_word_to_stop_and_the_way_on_follows_it) {
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
  EXPECT_EQ(pass(1.0), Texts{"go on, straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, says_once_more_that_the_route_is_new_if_that_was_cut) {
  under_way();
  now_.guidance->waypoint = {0.0, 5.0};
  now_.guidance->waypoint_angle = now_.guidance->steer_angle = -M_PI / 2.0;
  now_.guidance->waypoint_distance = 5.0;
  now_.guidance->reroutes = 1;
  EXPECT_EQ(pass(1.0), Texts{"new route, 9 o'clock, 5 meters"});
  policy_.note({{1, CueStage::started, last_.kind, last_.text}});
  EXPECT_EQ(pass(0.5), Texts{});
  policy_.note({{1, CueStage::cut, last_.kind, last_.text}});
  EXPECT_EQ(pass(0.5), Texts{"new route, 9 o'clock, 5 meters"});
}

TEST_F(CuePolicyTest, says_that_the_map_is_too_old) {
  under_way();
  now_.guidance->state = Guidance::State::map_stale;
  EXPECT_EQ(pass(5.0), Texts{"map out of date"});
}

TEST_F(CuePolicyTest, reminds_of_a_problem_that_lasts) {
  under_way();
  now_.guidance->state = Guidance::State::no_route;
  EXPECT_EQ(pass(31.0), Texts(3, "no route to the goal"));
}

TEST_F(CuePolicyTest, says_that_the_guidance_is_lost_and_goes_on_when_it_is_back) {
  under_way();
  now_.links.guidance = Link::lost;
  EXPECT_EQ(pass(1.0), Texts{"guidance lost"});
  EXPECT_EQ(pass(10.0), Texts{});
  now_.links.guidance = Link::alive;
  EXPECT_EQ(pass(0.5), Texts{"straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, names_only_the_simulator_when_all_dies_with_it) {
  under_way();
  now_.links.simulator = now_.links.guidance = now_.links.proximity = Link::lost;
  now_.gate = DriveState::State::stopped;
  EXPECT_EQ(pass(30.0), Texts{"simulator lost"});
  EXPECT_EQ(last_.priority, Priority::important);
}

TEST_F(CuePolicyTest, names_only_the_simulator_whichever_of_its_messages_is_missed_first) {
  under_way();
  now_.links.proximity = Link::lost;
  EXPECT_EQ(pass(0.1), Texts{});
  now_.links.simulator = now_.links.guidance = Link::lost;
  EXPECT_EQ(pass(30.0), Texts{"simulator lost"});
  now_.links.simulator = now_.links.guidance = now_.links.proximity = Link::alive;
  pass(5.0);
  now_.links.proximity = Link::lost;
  EXPECT_EQ(pass(1.0), Texts{"no obstacle sensing"}) << "where that alone is lost";
}

TEST_F(CuePolicyTest, distinguishes_a_stopped_robot_from_a_lost_controller) {
  under_way();
  now_.gate = DriveState::State::stopped;
  EXPECT_EQ(pass(1.0), Texts{"robot stopped, release the stick"});
  now_.gate = DriveState::State::running;
  pass(5.0);
  now_.links.pad = Link::lost;
  now_.gate = DriveState::State::stopped;
  EXPECT_EQ(pass(1.0), Texts{"controller disconnected"});
  now_.links.pad = Link::alive;
  EXPECT_EQ(pass(1.0),
            (Texts{"controller connected, release the stick", "straight ahead, 20 meters"}));
}

TEST_F(CuePolicyTest, names_the_keyboard_where_the_stick_is_one) {
  now_.keyboard = true;
  under_way();
  now_.links.pad = Link::lost;
  now_.gate = DriveState::State::stopped;
  EXPECT_EQ(pass(1.0), Texts{"the keys are off, select the keyboard window"});
  now_.links.pad = Link::alive;
  EXPECT_EQ(pass(1.0).front(), "the keys are on, release them first");
}

TEST_F(CuePolicyTest, says_a_notice_once) {
  under_way();
  now_.notices = {CueKind::no_rumble};
  EXPECT_EQ(pass(3.0), Texts{"this controller cannot rumble"});
  now_.notices.clear();
  EXPECT_EQ(pass(6.0), Texts{});
  now_.notices = {CueKind::no_rumble};
  EXPECT_EQ(pass(1.0), Texts{"this controller cannot rumble"}) << "another controller";
}

TEST_F(CuePolicyTest, names_the_person_whose_settings_are_used) {
  under_way();
  now_.person = "sub-01_b";
  now_.notices = {CueKind::settings_of};
  EXPECT_EQ(pass(1.0), Texts{"settings of sub-01 b"});
}

TEST_F(CuePolicyTest, mutes_what_a_person_does_without_but_no_safety_phrase_and_no_answer) {
  WordingConfig wording;
  wording.way = wording.near = false;
  policy_.use(wording);
  now_.goal_angle = 0.0;
  pass(1.0);
  now_.commanded.linear = now_.measured->linear = 0.3;
  now_.nearby = {{ThingClass::shelf, 1, 0.8, {0.5, 1.0}}};
  EXPECT_EQ(pass(5.0), Texts{});
  now_.commanded.linear = now_.measured->linear = 1.0;
  Texts approach;
  for (double gap = 2.0; gap > 0.5; gap -= 0.1) {
    now_.nearby = {{ThingClass::shelf, 1, gap, {gap + 0.4, 0.0}}};
    for (const std::string& text : pass(0.1)) approach.push_back(text);
  }
  EXPECT_EQ(approach, Texts{"stop, shelf ahead"});
  now_.nearby.clear();
  now_.measured->linear = 0.0;
  const std::string go_on = pass(5.0).front();
  EXPECT_EQ(go_on, "go on, straight ahead, 20 meters");
  for (const CueStage stage : {CueStage::queued, CueStage::started, CueStage::ended})
    policy_.note({{9, stage, CueKind::straight, go_on}});
  now_.question = Question::way;
  EXPECT_EQ(pass(0.5), Texts{"straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, words_things_otherwise_as_soon_as_it_is_wanted) {
  under_way();
  WordingConfig wording;
  wording.verbosity = "brief";
  policy_.use(wording);
  now_.question = Question::way;
  EXPECT_EQ(pass(0.5), Texts{"straight"});
}

TEST_F(CuePolicyTest, gives_no_direction_right_after_the_end_of_a_trial) {
  under_way();
  now_.notices = {CueKind::trial_time_up};
  EXPECT_EQ(pass(0.02), Texts{"time is up, the trial is over"});
  now_.notices.clear();
  now_.guidance->steer_angle = now_.guidance->waypoint_angle = 2.0;
  EXPECT_EQ(pass(9.0), Texts{});
  EXPECT_EQ(pass(2.0), Texts{"4 o'clock, 20 meters"}) << "the session goes on";
}

TEST_F(CuePolicyTest, says_what_was_hit_and_where_and_then_the_way_on) {
  under_way();
  now_.contacts = {{ThingClass::shelf, {0.0, 0.35}}};
  EXPECT_EQ(pass(0.1), Texts{"hit a shelf on the left"});
  EXPECT_EQ(last_.priority, Priority::important);
  EXPECT_EQ(last_.kind, CueKind::collision_shelf);
  EXPECT_EQ(pass(2.0), Texts{"straight ahead, 20 meters"});
  now_.contacts = {{ThingClass::forklift, {0.35, 0.0}}};
  EXPECT_EQ(pass(0.1), Texts{"hit a forklift ahead"});
}

TEST_F(CuePolicyTest, says_what_blocks_a_stuck_robot) {
  under_way();
  now_.nearby = {{ThingClass::box, 1, 0.15, {-0.1, -0.5}, false},
                 {ThingClass::pallet_robot, 2, 0.2, {0.6, 0.0}, true}};
  now_.measured->linear = 0.0;
  EXPECT_EQ(pass(1.4), Texts{});
  EXPECT_EQ(pass(0.3), Texts{"back away, pallet robot ahead"});
  now_.nearby.clear();
  const Texts later = pass(6.0);
  EXPECT_EQ(std::count(later.begin(), later.end(), "stuck"), 2);
}

TEST_F(CuePolicyTest, calls_no_robot_stuck_that_is_not_driven_or_is_held) {
  under_way();
  now_.commanded = {};
  now_.measured = Velocity{};
  Texts texts = pass(10.0);
  now_.commanded.linear = 1.0;
  now_.gate = DriveState::State::waiting;
  for (const std::string& text : pass(10.0)) texts.push_back(text);
  now_.gate = DriveState::State::running;
  now_.measured.reset();
  for (const std::string& text : pass(10.0)) texts.push_back(text);
  for (const std::string& text : texts) EXPECT_EQ(text.find("stuck"), std::string::npos);
}

TEST_F(CuePolicyTest, answers_a_question_at_once) {
  under_way();
  now_.voice_busy = true;
  now_.question = Question::way;
  EXPECT_EQ(pass(0.1), Texts{"straight ahead, 20 meters"});
  EXPECT_EQ(last_.priority, Priority::message);
  now_.goal_angle = -1.6;
  now_.question = Question::goal;
  EXPECT_EQ(pass(0.1), Texts{"goal 20 meters, 9 o'clock"});
  now_.guidance.reset();
  pass(3.0);
  now_.question = Question::goal;
  EXPECT_EQ(pass(0.1), Texts{"no goal yet"});
}

TEST_F(CuePolicyTest, tells_where_one_is_and_the_goal_from_there_in_one_frame) {
  const auto ask = [this](Question question) {
    now_.question = question;
    return pass(0.1);
  };
  under_way();
  now_.goal_angle = 1.6;
  now_.goal_straight = 12.0;
  EXPECT_EQ(ask(Question::where), Texts{"goal 12 meters, 3 o'clock from your nose"});
  now_.place = navvi_types::Place{navvi_types::Place::Kind::aisle, 3};
  EXPECT_EQ(ask(Question::where), Texts{"aisle 3, goal 12 meters, 3 o'clock from your nose"});
  now_.guidance->state = Guidance::State::arrived;
  pass(3.0);
  EXPECT_EQ(ask(Question::where), Texts{"aisle 3"});
  now_.place.reset();
  EXPECT_EQ(ask(Question::where), Texts{"You have reached your destination"});
}

TEST_F(CuePolicyTest, tells_the_next_turn_and_what_the_buttons_do) {
  under_way();
  now_.question = Question::turn;
  EXPECT_EQ(pass(0.1), Texts{"straight ahead, 20 meters"}) << "there is none before the goal";
  now_.guidance->waypoint_is_goal = false;
  now_.guidance->turn_angle = 1.6;
  now_.guidance->waypoint_distance = 18.0;
  now_.question = Question::turn;
  EXPECT_EQ(pass(0.1), Texts{"in 18 meters, turn to 3 o'clock"});
  now_.question = Question::help;
  EXPECT_EQ(pass(0.1).at(0).substr(0, 13), "lower repeats");
  now_.keyboard = true;
  now_.question = Question::help;
  EXPECT_EQ(pass(0.1).at(0).substr(0, 13), "space repeats");
}

TEST_F(CuePolicyTest, tells_what_is_around_clockwise_from_the_nearest) {
  now_.guidance.reset();
  now_.question = Question::around;
  EXPECT_EQ(pass(0.1), Texts{"nothing near"});
  now_.nearby = {{ThingClass::wall, 1, 0.5, {0.0, 0.9}, false},
                 {ThingClass::worker, 2, 1.0, {-1.4, 0.0}, true},
                 {ThingClass::shelf, 3, 1.1, {0.0, -1.5}, false},
                 {ThingClass::box, 4, 1.2, {0.2, -1.6}, false},
                 {ThingClass::forklift, 5, 2.9, {3.3, 0.0}, true},
                 {ThingClass::pallet_robot, 6, 3.1, {0.0, 3.5}, true}};
  now_.question = Question::around;
  const std::vector<Cue> told = policy_.update(now_, time_);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].text, "wall left, forklift ahead, shelf right, worker behind");
  ASSERT_EQ(told[0].scan.size(), 4U);
  EXPECT_EQ(told[0].scan[1].earcon, sounds::Earcon::forklift_near);
  EXPECT_EQ(told[0].scan[1].from, Eigen::Vector2d(3.3, 0.0));
}

TEST_F(CuePolicyTest, does_not_say_that_there_is_no_goal_while_a_path_may_be_on_its_way) {
  now_.guidance.reset();
  now_.question = Question::way;
  EXPECT_EQ(pass(4.0), Texts{});
}

TEST_F(CuePolicyTest, speaks_of_what_is_near_before_there_is_a_goal_only_while_the_robot_moves) {
  now_.guidance.reset();
  now_.nearby = {{ThingClass::shelf, 1, 0.5, {0.0, 0.9}, false}};
  EXPECT_EQ(pass(3.0), Texts{});
  now_.commanded.angular = now_.measured->angular = 0.5;
  EXPECT_EQ(pass(1.0), Texts{"shelf on the left"});
}

TEST_F(CuePolicyTest,
       falls_silent_about_the_way_without_a_controller_and_says_it_anew_when_it_is_back) {
  under_way();
  now_.commanded = {};
  now_.measured = Velocity{};
  now_.guidance->waypoint_angle = now_.guidance->steer_angle = 1.6;
  now_.links.pad = Link::lost;
  EXPECT_EQ(pass(30.0), Texts{"controller disconnected"});
  now_.links.pad = Link::alive;
  EXPECT_EQ(pass(1.0), (Texts{"controller connected, release the stick", "3 o'clock, 20 meters"}));
}

TEST_F(CuePolicyTest, asks_to_release_a_stick_that_is_held_in_vain_and_then_says_the_way) {
  under_way();
  now_.commanded = {};
  now_.measured = Velocity{};
  now_.stick_held_unarmed = true;
  const Texts held = pass(5.0);
  EXPECT_EQ(std::count(held.begin(), held.end(), "release the stick"), 2);
  now_.stick_held_unarmed = false;
  EXPECT_EQ(pass(3.0), Texts{"straight ahead, 20 meters"});
}

TEST_F(CuePolicyTest, asks_nobody_to_release_the_stick_who_has_arrived) {
  under_way();
  now_.guidance->state = Guidance::State::arrived;
  EXPECT_EQ(pass(0.1), Texts{"You have reached your destination"});
  now_.stick_held_unarmed = true;  // the trial is over
  EXPECT_EQ(pass(10.0), Texts{});
}

TEST_F(CuePolicyTest, says_every_thing_that_is_hit_but_the_same_only_once_in_a_while) {
  under_way();
  now_.contacts = {{ThingClass::box, {0.35, 0.0}, 4}, {ThingClass::pedestal, {0.0, -0.35}, 5}};
  EXPECT_EQ(pass(0.5), (Texts{"hit a box ahead", "hit a pedestal on the right"}));
  now_.contacts = {{ThingClass::box, {0.35, 0.0}, 4}, {ThingClass::box, {0.0, 0.35}, 6}};
  EXPECT_EQ(pass(0.5), Texts{"hit a box on the left"});
  pass(3.0);
  now_.contacts = {{ThingClass::box, {0.35, 0.0}, 4}};
  EXPECT_EQ(pass(0.1), Texts{"hit again, box ahead"});
}

TEST_F(CuePolicyTest, may_say_again_at_once_what_was_dropped) {
  under_way();
  const auto lose_and_find = [&] {
    now_.links.proximity = Link::alive;
    pass(0.1);
    now_.links.proximity = Link::lost;
    return pass(0.4);
  };
  EXPECT_EQ(lose_and_find(), Texts{"no obstacle sensing"});
  EXPECT_EQ(lose_and_find(), Texts{});
  policy_.note({{1, CueStage::dropped, last_.kind, last_.text}});
  EXPECT_EQ(lose_and_find(), Texts{"no obstacle sensing"});
}

TEST_F(CuePolicyTest, words_directions_by_left_and_right_where_that_is_wanted) {
  CuePolicyConfig config;
  config.wording.directions = "left_right";
  policy_ = CuePolicy(config, Phrases(kEnglish, config.wording));
  now_.guidance->waypoint_angle = now_.guidance->steer_angle = -1.6;
  EXPECT_EQ(pass(1.0), (Texts{"Ready. Goal 20 meters", "left, 20 meters"}));
}

TEST_F(CuePolicyTest, does_not_chatter_on_a_quiet_drive) {
  under_way();
  EXPECT_LE(pass(60.0).size(), 8U);
}

TEST_F(CuePolicyTest, has_a_kind_for_every_state_and_refusal_of_the_guidance) {
  for (std::size_t state = 0; state < names(Guidance::State{}).size(); ++state) {
    for (std::size_t refusal = 0; refusal < names(Guidance::Refusal{}).size(); ++refusal) {
      now_.guidance->state = static_cast<Guidance::State>(state);
      now_.guidance->refusal = static_cast<Guidance::Refusal>(refusal);
      EXPECT_NO_THROW(pass(4.0)) << to_string(now_.guidance->state);
    }
  }
}

TEST_F(CuePolicyTest, speaks_what_can_be_spoken_in_any_situation) {
  std::mt19937 random(1);
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto link = [&] { return static_cast<Link>(draw(3)); };
  const auto number = [&](double scale) { return scale * (draw(2001) - 1000) / 1000.0; };
  for (int tick = 0; tick < 20000; ++tick) {
    if (tick % 20 == 0) {
      now_.links.pad = link();
      now_.links.simulator = draw(4) == 0 ? link() : Link::alive;
      now_.links.proximity = link();
      now_.links.guidance = draw(4) == 0 ? link() : Link::alive;
      now_.gate = navvi_types::from_number<DriveState::State>(static_cast<std::uint8_t>(draw(4)));
      now_.guidance->state = static_cast<Guidance::State>(draw(3) == 0 ? draw(8) : 1);
      now_.guidance->refusal = static_cast<Guidance::Refusal>(draw(6));
      now_.guidance->goal = {number(20), number(20)};
      now_.guidance->waypoint = {number(20), number(20)};
    }
    now_.guidance->waypoint_angle = now_.guidance->steer_angle = number(3.2);
    now_.guidance->turn_angle = number(3.2);
    now_.guidance->waypoint_distance = std::abs(number(20));
    now_.commanded = {number(1), number(1)};
    now_.measured = Velocity{number(1), number(1)};
    now_.nearby = {{static_cast<ThingClass>(1 + draw(8)),
                    1,
                    std::abs(number(2)),
                    {number(2), number(2)},
                    false}};
    if (draw(30) == 0)
      now_.contacts = {{static_cast<ThingClass>(1 + draw(8)), {number(1), number(1)}}};
    now_.voice_busy = draw(2) == 0;
    now_.question.reset();
    if (draw(50) == 0) now_.question = static_cast<Question>(draw(3));
    now_.stick_held_unarmed = draw(2) == 0;
    time_ += 0.02;
    for (const Cue& cue : policy_.update(now_, time_)) {
      EXPECT_TRUE(speakable(cue.text));
    }
    now_.contacts.clear();
  }
}

}  // namespace
}  // namespace navvi_feedback::cues
