#include "core/auditory_display.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "guide_fixture.hpp"

namespace navvi_feedback::core {
namespace {

using sounds::Earcon;

/// How often the beacon sounds in 10 s.
int beacons(bool on, std::optional<double> waypoint_distance) {
  sounds::SoundsConfig config;
  config.beacon.on = on;
  AuditoryDisplay display(config);
  Observation now;
  if (waypoint_distance) now.guidance.emplace().waypoint_distance = *waypoint_distance;
  std::vector<cues::Cue> cues;
  int times = 0;
  for (int i = 0; i < 500; ++i)
    for (const sounds::Play& play : display.update(cues, now, {0.0, false, {}}, {}, i * 0.02))
      times += play.earcon == Earcon::beacon ? 1 : 0;
  return times;
}

TEST(AuditoryDisplay, has_a_beacon_where_asked_for_that_quickens_up_to_the_capture_radius) {
  EXPECT_EQ(beacons(false, 5.0), 0);
  const int far = beacons(true, 10.0);
  EXPECT_NEAR(far, 9, 1);
  EXPECT_GT(beacons(true, 2.0), 2 * far);
  EXPECT_EQ(beacons(true, 1.4), 0);
  EXPECT_EQ(beacons(true, std::nullopt), 0);
}

TEST_F(GuideTest, a_hit_is_said_and_sounds_once_from_its_side) {
  guide_.take(Odometry{}, time_);
  guide_.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
  pass(3.0);
  ASSERT_EQ(plays_.size(), 1U);
  EXPECT_EQ(plays_[0].earcon, Earcon::hit_shelf);
  EXPECT_GT(plays_[0].from.y(), 0.0);
  EXPECT_EQ(count({CueKind::collision, About::shelf}), 1);
}

TEST_F(GuideTest, sounds_do_the_work_of_words_while_they_are_heard) {
  drive_along(0.9, 10);
  EXPECT_GT(played(Earcon::turn), 5);
  EXPECT_EQ(played(Earcon::shelf_near), 1);
  EXPECT_FALSE(said({CueKind::near, About::shelf}));
  input_.sounds = false;
  plays_.clear();
  drive_along(-0.9, 10);
  EXPECT_TRUE(plays_.empty());
  EXPECT_TRUE(said({CueKind::near, About::shelf}));
}

TEST_F(GuideTest, words_win_over_sounds_but_not_over_a_hit_and_a_turn_is_still_counted) {
  input_.speaking = true;
  ask({drive::Button::repeat});
  guide_.take(Contact{ThingClass::shelf, {0.0, 0.4}, 7}, time_);
  drive_along(0.9, 4);
  EXPECT_EQ(played(Earcon::turn), 0);
  ASSERT_GT(played(Earcon::turn_click), 1);
  const sounds::SoundsConfig config;
  for (const sounds::Play& play : plays_) {
    const bool hit = play.earcon == Earcon::hit_shelf;
    const double full = config.family_of(play.earcon).volume;
    EXPECT_NEAR(play.volume, hit ? full : config.kUnderWords * full, 1e-9);
  }
}

TEST_F(GuideTest, no_turn_is_counted_down_to_who_must_stop_or_does_not_drive) {
  drive_along(0.9, 20);
  EXPECT_GT(std::exchange(plays_, {}).size(), 5U);
  pass(0.5);
  EXPECT_TRUE(plays_.empty()) << "has not moved the stick for long";
}

}  // namespace
}  // namespace navvi_feedback::core
