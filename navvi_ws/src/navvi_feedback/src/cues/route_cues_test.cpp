#include "cues/route_cues.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "route_drive.hpp"

namespace navvi_feedback::cues {
namespace {

TEST(RouteCues, say_the_way_to_a_new_goal_and_then_where_that_is_or_how_far) {
  Drive drive;
  drive.now.guidance = following(90.0, 8.0);
  Drive unknown = drive;
  drive.now.goal_angle = rad(-60.0);
  EXPECT_EQ(drive.pass(kTick), (Kinds{CueKind::direction, CueKind::start}));
  EXPECT_EQ(drive.last.fillings.side, Side::left);
  EXPECT_DOUBLE_EQ(*drive.last.fillings.distance, 25.0);
  drive.now.voice_busy = true;
  EXPECT_EQ(drive.pass(2.0), Kinds{});
  EXPECT_EQ(unknown.pass(kTick), (Kinds{CueKind::direction, {CueKind::start, About::distance}}));
}

TEST(RouteCues, introduce_a_goal_that_is_not_seen_as_such_without_the_length_of_the_path) {
  for (const bool sound : {true, false}) {
    Drive drive;
    drive.now.lead = sound ? Lead::ticks : Lead::words;
    drive.now.goal_angle = rad(-60.0);
    drive.now.guidance = following(90.0, 8.0);
    drive.now.guidance->ends_short = true;
    EXPECT_EQ(drive.pass(kTick), (Kinds{CueKind::toward_goal, CueKind::direction}));
    const Kinds more = drive.pass(5.0);
    EXPECT_EQ(std::count(more.begin(), more.end(), CueKind::toward_goal), 0);
  }
}

TEST(RouteCues, say_once_that_the_goal_is_seen_now_and_once_that_it_is_not_any_more) {
  for (const bool sound : {true, false}) {
    Drive drive;
    drive.now.lead = sound ? Lead::ticks : Lead::words;
    drive.now.guidance = following(0.0, 30.0);
    drive.now.guidance->ends_short = true;
    drive.now.commanded.linear = drive.now.measured->linear = 1.0;
    drive.pass(3.0);
    drive.now.guidance->ends_short = false;
    EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::goal_seen});
    EXPECT_DOUBLE_EQ(*drive.last.fillings.distance, 25.0);
    EXPECT_EQ(drive.pass(3.0), Kinds{});
    drive.now.guidance->ends_short = true;
    EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::toward_goal});
    EXPECT_EQ(drive.pass(3.0), Kinds{});
  }
}

TEST(RouteCues, say_again_that_the_goal_is_not_seen_if_it_was_not_heard) {
  Drive drive;
  drive.now.guidance = following(0.0, 30.0);
  drive.now.guidance->ends_short = true;
  drive.now.commanded.linear = drive.now.measured->linear = 1.0;
  drive.pass(3.0);
  for (int i = 0; i < 3; ++i) {
    drive.cues.lost(CueKind::toward_goal, drive.time);
    EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::toward_goal});
    drive.cues.lost(CueKind::toward_goal, drive.time);
    EXPECT_EQ(drive.pass(0.2), Kinds{}) << "none that finds no room either";
    EXPECT_EQ(drive.pass(0.12), Kinds{CueKind::toward_goal});
    drive.pass(1.0);
  }
  drive.now.guidance->ends_short = false;
  drive.pass(0.4);
  drive.cues.lost(CueKind::goal_seen, drive.time);
  EXPECT_EQ(drive.pass(1.0), Kinds{}) << "who never heard that it was not seen";
  drive.now.guidance->ends_short = true;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::toward_goal});
  drive.cues.note(CueKind::toward_goal, CueStage::started);
  drive.now.guidance->ends_short = false;
  EXPECT_EQ(drive.pass(0.4), Kinds{CueKind::goal_seen});
  drive.cues.lost(CueKind::goal_seen, drive.time);
  EXPECT_EQ(drive.pass(0.32), Kinds{CueKind::goal_seen});
}

TEST(RouteCues, tell_a_person_who_waited_meanwhile_that_the_new_goal_is_not_seen) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance->goal = {50.0, 5.0};
  drive.now.guidance->ends_short = true;
  const Utterances on = drive.go_on();
  ASSERT_EQ(on.size(), 1U);
  EXPECT_TRUE(on[0].also.empty()) << "not how far the goal is";
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::toward_goal});
}

TEST(RouteCues, name_no_goal_seen_while_room_is_made) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance->ends_short = true;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::toward_goal});
  drive.now.guidance->state = Guidance::State::make_room;
  drive.now.guidance->ends_short = false;
  const Kinds told = drive.pass(3.0);
  EXPECT_EQ(std::count(told.begin(), told.end(), CueKind::goal_seen), 0);
}

TEST(RouteCues, urge_a_hand_that_rests_for_3_s_at_the_begin_of_a_straight_leg_once) {
  Drive drive;
  drive.now.guidance = following(0.0, 8.0);
  drive.now.voice_busy = true;
  drive.pass(2.0);
  drive.now.voice_busy = false;
  EXPECT_EQ(drive.pass(2.9), Kinds{});
  EXPECT_EQ(drive.pass(0.2), Kinds{CueKind::push});
  EXPECT_EQ(drive.pass(5.0), Kinds{}) << "once a leg";
}

TEST(RouteCues, urge_no_hand_that_has_driven_turns_or_has_something_before_it) {
  Drive driven, turning, before;
  for (Drive* const drive : {&driven, &turning, &before}) {
    drive->now.guidance = following(0.0, 8.0);
    drive->pass(kTick);
  }
  driven.now.commanded.linear = 0.5;
  driven.pass(0.5);
  driven.now.commanded.linear = 0.0;
  turning.now.commanded.angular = 0.5;
  before.now.nearby = {{ThingClass::box, 1, 0.3, {0.7, 0.0}}};
  for (Drive* const drive : {&driven, &turning, &before}) EXPECT_EQ(drive->pass(5.0), Kinds{});
}

TEST(RouteCues, say_nothing_of_an_angle_that_is_no_number) {
  Drive drive;
  drive.now.guidance = following(std::nan(""), 8.0);
  EXPECT_EQ(drive.pass(10.0), Kinds{});
  drive.now.guidance = following(0.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(drive.pass(10.0), Kinds{});
  EXPECT_FALSE(drive.cues.ask(*drive.now.guidance, drive.time));
}

TEST(RouteCues, do_not_say_by_themselves_what_was_just_answered) {
  Drive drive;
  drive.settle(0.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.pass(6.0);
  EXPECT_EQ(drive.cues.ask(*drive.now.guidance, drive.time).value().kind, CueKind::straight);
  EXPECT_EQ(drive.pass(19.0), Kinds{});
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::straight});
}

TEST(RouteCues, say_a_route_that_changed_while_the_person_waited) {
  for (const bool sound : {true, false})
    for (const auto& [angle, hour] : {std::pair(120.0, 4), std::pair(0.0, 12)}) {
      Drive drive;
      drive.now.lead = sound ? Lead::ticks : Lead::words;
      drive.settle(0.0, 30.0);
      drive.now.guidance->reroutes = 1;
      drive.lead_to(0.0, -12.0);
      drive.face(angle);
      const Utterances on = drive.go_on();
      ASSERT_EQ(on.size(), 1U);
      EXPECT_EQ(on[0].kind, CueKind::rerouted);
      EXPECT_EQ(on[0].fillings.hour, hour);
      EXPECT_EQ(drive.pass(2.0), Kinds{});
    }
}

TEST(RouteCues, call_no_route_new_whose_way_was_told) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance = following(0.0, 3.0);
  drive.now.guidance->reroutes = 1;
  drive.lead_to(0.0, -12.0);
  EXPECT_EQ(drive.go_on().at(0).kind, CueKind::rerouted);
  const RouteCues told = drive.cues;
  drive.cues.pause(false);
  drive.now.guidance->steer_angle = rad(-30.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::direction});
  drive.cues = told;
  drive.cues.lost(CueKind::straight, drive.time);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::rerouted});
}

TEST(RouteCues, say_the_direction_again_after_a_stop_and_when_the_path_is_back) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.cues.remind(drive.time + 1.0);
  EXPECT_EQ(drive.pass(0.9), Kinds{});
  EXPECT_EQ(drive.pass(0.2), Kinds{CueKind::straight});
  drive.cues.pause(false);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::straight}) << "without a new introduction";
  drive.cues.pause(true);
  EXPECT_EQ(drive.pass(kTick), (Kinds{CueKind::straight, {CueKind::start, About::distance}}));
}

}  // namespace
}  // namespace navvi_feedback::cues
