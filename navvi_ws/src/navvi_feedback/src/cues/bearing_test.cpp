#include "cues/bearing.hpp"

#include <gtest/gtest.h>

#include "route_drive.hpp"

namespace navvi_feedback::cues {
namespace {

TEST(LeadOff, send_nobody_straight_ahead_into_a_thing_that_the_path_avoids) {
  Drive drive;
  drive.settle(10.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  EXPECT_EQ(drive.cues.ask(*drive.now.guidance, drive.time).value().kind, CueKind::straight);
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.4, {0.7, 0.2}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight});
  EXPECT_EQ(drive.last.fillings.side, Side::right);
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.4, {0.2, -0.7}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight}) << "on the way's side, and not in the way";
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.4, {0.2, 0.7}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight}) << "the way leads off from it";
}

TEST(LeadOff, lead_off_from_what_is_all_but_touched_however_straight_the_path) {
  Drive drive;
  drive.settle(0.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.03, {0.02, 0.4}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight});
  EXPECT_EQ(drive.last.fillings.side, Side::right);
  drive.now.nearby.push_back(NearThing{ThingClass::shelf, 2, 0.05, {0.02, -0.4}, false});
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight}) << "between two";
}

TEST(LeadOff, send_nobody_aside_into_a_thing) {
  Drive drive;
  drive.settle(8.0, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  EXPECT_EQ(drive.cues.ask(*drive.now.guidance, drive.time).value().kind, CueKind::straight);
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.55, {0.78, -0.45}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{}) << "30 degrees to the right is where it stands";
}

TEST(LeadOff, lead_aside_and_ahead_again_only_once_the_angle_has_clearly_changed) {
  Drive drive;
  drive.settle(7.5, 20.0);
  drive.now.guidance->waypoint_is_goal = true;
  drive.now.nearby = {NearThing{ThingClass::shelf, 1, 0.45, {0.8, 0.2}, false}};
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::slight});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(6.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{});
  drive.now.guidance->waypoint_angle = drive.now.guidance->steer_angle = rad(3.0);
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight});
}

}  // namespace
}  // namespace navvi_feedback::cues
