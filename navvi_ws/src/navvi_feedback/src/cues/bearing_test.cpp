#include "cues/bearing.hpp"

#include <gtest/gtest.h>

#include "route_drive.hpp"

namespace navvi_feedback::cues {
namespace {

/// On the way to a goal 20 m ahead, and so far to the right.
class LeadOff : public testing::Test {
 protected:
  void settle(double degrees) {
    drive.settle(degrees, 20.0);
    drive.now.guidance->waypoint_is_goal = true;
  }
  /// What is said beside a shelf.
  Kinds past(double gap, double x, double y) {
    drive.now.nearby = {NearThing{ThingClass::shelf, 1, gap, {x, y}, false}};
    return drive.pass(3.0);
  }
  [[nodiscard]] CueKind asked() { return drive.cues.ask(*drive.now.guidance, drive.time)->kind; }

  Drive drive;
};

TEST_F(LeadOff, send_nobody_straight_ahead_into_a_thing_that_the_path_avoids) {
  settle(10.0);
  EXPECT_EQ(asked(), CueKind::straight);
  EXPECT_EQ(past(0.4, 0.7, 0.2), Kinds{CueKind::slight});
  EXPECT_EQ(drive.last.fillings.side, Side::right);
  EXPECT_EQ(past(0.4, 0.2, -0.7), Kinds{CueKind::straight}) << "on the way's side, not in it";
  EXPECT_EQ(past(0.4, 0.2, 0.7), Kinds{CueKind::slight}) << "the way leads off from it";
}

TEST_F(LeadOff, lead_off_from_what_is_all_but_touched_however_straight_the_path) {
  settle(0.0);
  EXPECT_EQ(past(0.03, 0.02, 0.4), Kinds{CueKind::slight});
  EXPECT_EQ(drive.last.fillings.side, Side::right);
  drive.now.nearby.push_back(NearThing{ThingClass::shelf, 2, 0.05, {0.02, -0.4}, false});
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight}) << "between two";
}

TEST_F(LeadOff, send_nobody_aside_into_a_thing) {
  settle(8.0);
  EXPECT_EQ(asked(), CueKind::straight);
  EXPECT_EQ(past(0.55, 0.78, -0.45), Kinds{}) << "30 degrees to the right is where it stands";
}

TEST_F(LeadOff, lead_aside_and_ahead_again_only_once_the_angle_has_clearly_changed) {
  settle(7.5);
  EXPECT_EQ(past(0.45, 0.8, 0.2), Kinds{CueKind::slight});
  drive.face(6.0);
  EXPECT_EQ(drive.pass(kTick), Kinds{});
  drive.face(3.0);
  EXPECT_EQ(drive.pass(3.0), Kinds{CueKind::straight});
}

}  // namespace
}  // namespace navvi_feedback::cues
