#include "cues/route_rules.hpp"

#include <gtest/gtest.h>

#include "route_drive.hpp"

namespace navvi_feedback::cues {
namespace {

TEST(SoundsLead, leave_corrections_to_the_sound_while_it_is_heard) {
  for (const bool sound : {true, false}) {
    Drive drive;
    drive.now.lead = sound ? Lead::ticks : Lead::words;
    drive.settle(0.0, 20.0);
    Kinds said;
    for (const double off : {30.0, -30.0, 60.0, 0.0}) {
      drive.now.guidance = following(off, 15.0);
      const Kinds more = drive.pass(3.0);
      said.insert(said.end(), more.begin(), more.end());
    }
    EXPECT_EQ(said.empty(), sound);
  }
}

TEST(SoundsLead, say_a_turn_once_and_no_bend_where_a_sound_leads_round) {
  for (const double turn : {90.0, 30.0}) {
    for (const bool announced : {true, false}) {
      Drive drive;
      drive.now.lead = Lead::ticks;
      drive.settle(0.0, 20.0);
      drive.now.guidance = following(0.0, 5.0);
      drive.now.guidance->turn_angle = announced ? rad(turn) : 0.0;
      const bool worth_words = turn > 45.0;
      EXPECT_EQ(drive.pass(3.0), worth_words && announced ? Kinds{CueKind::turn_ahead} : Kinds{});
      drive.now.guidance->waypoint_distance = 0.5;
      drive.pass(1.0);
      drive.now.guidance = following(turn, 12.0);
      drive.lead_to(10.0, 12.0);
      EXPECT_EQ(drive.pass(3.0), worth_words && !announced ? Kinds{CueKind::turn_now} : Kinds{});
      drive.now.guidance->steer_angle = 0.0;
      EXPECT_EQ(drive.pass(3.0), worth_words && announced ? Kinds{CueKind::straight} : Kinds{});
    }
  }
}

TEST(SoundsLead, say_a_long_leg_again_every_20_s_and_no_end_of_it) {
  Drive drive;
  drive.now.lead = Lead::ticks;
  drive.settle(0.0, 40.0);
  EXPECT_EQ(drive.pass(45.0), (Kinds{CueKind::straight, CueKind::straight}));
  drive.now.guidance->waypoint_distance = 8.0;
  EXPECT_EQ(drive.pass(45.0), Kinds{});
}

}  // namespace
}  // namespace navvi_feedback::cues
