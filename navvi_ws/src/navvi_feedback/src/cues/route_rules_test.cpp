#include "cues/route_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "route_drive.hpp"

namespace navvi_feedback::cues {
namespace {

TEST(RouteRules, announce_a_turn_once_ahead_and_once_when_the_corner_is_reached) {
  Drive drive;
  drive.settle(0.0, 12.0);
  Kinds said;
  for (double distance = 12.0; distance > 1.0; distance -= kTick) {
    drive.now.guidance->waypoint_distance = distance;
    for (const Content& kind : drive.pass(kTick)) {
      if (kind == CueKind::turn_ahead) {
        EXPECT_LE(distance, 6.0);
        EXPECT_GT(distance, 4.0);
        EXPECT_EQ(drive.last.fillings.hour, 3);
      }
      said.push_back(kind);
    }
  }
  EXPECT_EQ(std::count(said.begin(), said.end(), CueKind::turn_ahead), 1);
  drive.now.guidance = following(80.0, 9.0);
  drive.lead_to(10.0, -10.0);
  drive.now.voice_busy = true;  // it does not wait for a lesser cue to end
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::turn_now});
  EXPECT_EQ(drive.last.fillings.hour, 3);
}

TEST(RouteRules, name_the_turn_where_straight_ahead_alone_would_lead_past_it) {
  Drive drive;
  drive.settle(90.0, 3.0);
  drive.now.guidance = following(0.0, 3.0);
  EXPECT_EQ(drive.pass(2.0), (Kinds{{CueKind::straight, About::then}}));
  EXPECT_EQ(drive.last.fillings.hour, 3);
  EXPECT_EQ(drive.pass(10.0), Kinds{}) << "the turn was announced";
}

TEST(RouteRules, say_that_an_announced_turn_falls_away_but_keep_one_that_a_plan_moves_a_little) {
  for (const bool falls_away : {true, false}) {
    Drive drive;
    drive.settle(0.0, 12.0);
    drive.now.guidance->waypoint_distance = 4.5;
    EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::turn_ahead});
    drive.now.guidance = following(0.0, falls_away ? 14.0 : 5.5);
    drive.lead_to(falls_away ? 20.0 : 11.5, 0.0);
    EXPECT_EQ(drive.pass(4.0), falls_away ? Kinds{CueKind::turn_cancelled} : Kinds{});
  }
}

TEST(RouteRules, keep_quiet_about_a_turn_at_the_goal) {
  Drive drive;
  drive.now.guidance = following(0.0, 5.0);
  drive.now.guidance->waypoint_is_goal = true;
  const Kinds said = drive.pass(20.0);
  EXPECT_EQ(std::count(said.begin(), said.end(), CueKind::turn_ahead), 0);
}

TEST(RouteRules, say_a_new_route_only_if_the_next_manoeuvre_changed) {
  Drive drive;
  drive.settle(0.0, 30.0);
  for (int plan = 0; plan < 3; ++plan) {
    drive.now.guidance->replan_reason = Guidance::Replan::period;
    drive.now.guidance->waypoint += Eigen::Vector2d(plan % 2 == 0 ? 1.5 : -1.5, 0.2);
    EXPECT_EQ(drive.pass(1.5), Kinds{}) << plan;
  }
  drive.lead_to(0.0, -12.0);
  drive.face(150.0);
  drive.now.guidance->waypoint_distance = 12.0;
  EXPECT_EQ(drive.pass(1.0), Kinds{CueKind::rerouted});
  EXPECT_EQ(drive.last.fillings.hour, 5);
}

TEST(RouteRules, say_that_the_old_way_is_blocked_once_for_each_reroute) {
  Drive drive;
  drive.settle(0.0, 30.0);
  drive.now.guidance->reroutes = 1;
  drive.now.guidance->reroute_reason = Guidance::Replan::path_carved;
  drive.lead_to(0.0, -12.0);
  drive.face(150.0);
  EXPECT_EQ(drive.pass(1.0), (Kinds{{CueKind::rerouted, About::blocked}}));
  drive.lead_to(9.0, -12.0);
  drive.face(60.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::rerouted});
}

TEST(RouteRules, name_once_the_thing_to_make_room_for_and_then_the_way) {
  Drive drive;
  drive.settle(0.0, 12.0);
  drive.now.guidance = following(170.0, 3.0);
  drive.now.guidance->state = Guidance::State::make_room;
  drive.now.guidance->blocked_by = ThingClass::forklift;
  drive.now.voice_busy = true;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::make_room});
  EXPECT_EQ(drive.last.fillings.thing, ThingClass::forklift);
  EXPECT_EQ(drive.last.fillings.hour, 6);
  EXPECT_EQ(drive.pass(1.0), Kinds{});
  drive.now.voice_busy = false;
  EXPECT_EQ(drive.pass(6.0), Kinds{CueKind::direction}) << "words alone lead";
  drive.now.guidance = following(0.0, 12.0);
  drive.pass(6.0);
  drive.now.guidance = following(90.0, 3.0);
  drive.now.guidance->state = Guidance::State::make_room;
  EXPECT_EQ(drive.pass(kTick), Kinds{CueKind::make_room});
  drive.now.voice_busy = true;
  drive.cues.lost(CueKind::make_room, drive.time);
  EXPECT_EQ(drive.pass(0.28), Kinds{}) << "it would find no room again";
  EXPECT_EQ(drive.pass(0.06), Kinds{CueKind::make_room});
}

TEST(RouteRules, judge_a_new_leg_afresh_and_call_a_new_route_by_its_name) {
  Drive drive;
  drive.settle(0.0, 1.5);
  Drive rerouted = drive;
  drive.now.guidance = following(17.0, 8.0);
  drive.lead_to(10.0, 8.0);
  EXPECT_EQ(drive.pass(2.0), Kinds{CueKind::turn_now});
  EXPECT_EQ(drive.last.fillings.hour, 1) << "17 degrees would still be held as 12 on the old leg";
  rerouted.now.guidance = following(90.0, 8.0);
  rerouted.now.guidance->reroutes = 1;
  rerouted.lead_to(10.0, 8.0);
  EXPECT_EQ(rerouted.pass(2.0), Kinds{CueKind::rerouted});
}

}  // namespace
}  // namespace navvi_feedback::cues
