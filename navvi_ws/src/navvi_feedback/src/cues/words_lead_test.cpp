#include "cues/route_rules.hpp"

#include <gtest/gtest.h>

#include "route_drive.hpp"

namespace navvi_feedback::cues {
namespace {

TEST(WordsLead, repeat_the_direction_half_as_often_to_a_hand_that_rests_and_straight_seldom) {
  Drive drive;
  drive.settle(90.0, 8.0);
  Drive rests = drive, straight;
  EXPECT_EQ(drive.pass(18.0), (Kinds{CueKind::direction, CueKind::direction, CueKind::direction}));
  rests.now.commanded = {};
  rests.pass(12.0);
  EXPECT_EQ(rests.pass(24.0).size(), 2U);
  straight.settle(0.0, 30.0);
  EXPECT_EQ(straight.pass(40.0), (Kinds{CueKind::straight, CueKind::straight}));
}

TEST(WordsLead, say_the_direction_again_to_who_turns_away_from_it) {
  Drive drive;
  drive.settle(25.0, 12.0);
  drive.face(38.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{});
  drive.face(44.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::direction}) << "although it is the same hour";
}

TEST(WordsLead, correct_only_beyond_the_hysteresis) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.face(18.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{});
  drive.face(21.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::direction});
  EXPECT_EQ(drive.last.fillings.hour, 1);
}

TEST(WordsLead, leave_out_the_hours_that_a_turning_robot_passes_and_say_when_to_stop) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.measured = Velocity{0.0, -1.0};
  double degrees = 90.0;
  Kinds said;
  double angle_when_told = 0.0;
  while (degrees > 0.0) {
    degrees -= kTick / M_PI * 180.0;
    drive.face(degrees);
    for (const Content& kind : drive.pass(kTick)) {
      said.push_back(kind);
      angle_when_told = degrees;
    }
  }
  EXPECT_EQ(said, Kinds{CueKind::straight});
  EXPECT_EQ(drive.last.priority, Priority::message);
  EXPECT_GT(angle_when_told, 20.0) << "a person needs a moment to stop";
  EXPECT_LT(angle_when_told, 60.0);
}

TEST(WordsLead, tell_a_robot_that_turned_too_far_once_it_has_settled) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.measured = Velocity{0.0, -1.0};
  drive.face(10.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::straight});
  drive.face(-30.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{});
  drive.now.measured = Velocity{};
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::direction});
  EXPECT_EQ(drive.last.fillings.hour, 11);
}

TEST(WordsLead, say_straight_ahead_in_a_turn_not_more_than_an_hour_too_early) {
  Drive drive;
  drive.settle(90.0, 8.0);
  drive.now.commanded = {0.0, -1.2};
  drive.now.measured->linear = 0.0;
  drive.now.measured->angular = -1.2;
  for (const double degrees : {60.0, 45.0, 29.0, 10.0}) {  // 45: half a second later it faces it
    drive.face(degrees);
    EXPECT_EQ(drive.pass(kTick), degrees == 29.0 ? Kinds{CueKind::straight} : Kinds{}) << degrees;
  }
}

TEST(WordsLead, let_a_turn_by_one_hour_end_by_itself) {
  for (const double side : {1.0, -1.0}) {
    Drive drive;
    drive.settle(side * 30.0, 8.0);
    drive.now.measured->linear = 0.0;
    drive.now.measured->angular = -side * 1.2;
    for (const double degrees : {30.0, 25.0, 15.0, 5.0, -5.0, -10.0}) {
      drive.face(side * degrees);
      EXPECT_EQ(drive.pass(kTick), Kinds{}) << degrees;
    }
    drive.now.measured->angular = 0.0;
    EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::straight});
  }
}

TEST(WordsLead, do_not_correct_a_robot_that_is_about_to_pass_the_corner_near_enough) {
  Drive drive;
  drive.settle(0.0, 8.0);
  drive.now.guidance->waypoint_distance = 1.4;
  drive.face(28.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{});
}

TEST(WordsLead, do_not_waver_between_the_hours_ahead_just_before_the_way_point) {
  Drive drive;
  drive.settle(0.0, 8.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.now.guidance->waypoint_distance = 0.95;
  Kinds said;
  for (int i = 0; i < 10; ++i) {
    drive.face(i % 2 == 0 ? -40.0 : 0.0);
    for (const Content& kind : drive.pass(2.0)) said.push_back(kind);
  }
  EXPECT_EQ(said, Kinds{});
  EXPECT_TRUE(drive.cues.ask(*drive.now.guidance, drive.time)) << "who asks is told";
  drive.pass(2.0);
  drive.face(100.0);
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::direction}) << "who missed it is told";
}

TEST(WordsLead, tell_a_person_who_stands_just_before_the_way_point_to_go_on) {
  Drive drive;
  drive.settle(0.0, 0.9);
  drive.now.commanded = {};
  EXPECT_FALSE(drive.pass(20.0).empty());
}

}  // namespace
}  // namespace navvi_feedback::cues
