#include "core/auditory_display.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::core {
namespace {

using sounds::Earcon;

/// How often it sounds in 10 s.
int count(const sounds::SoundsConfig& config, Earcon earcon, const Observation& now) {
  AuditoryDisplay display(config);
  std::vector<cues::Cue> cues;
  int times = 0;
  for (int i = 0; i < 500; ++i)
    for (const sounds::Play& play : display.update(cues, now, {0.0, false, {}}, {}, i * 0.02))
      times += play.earcon == earcon ? 1 : 0;
  return times;
}

Observation with_waypoint_in(double distance) {
  Observation now;
  now.guidance.emplace();
  now.guidance->waypoint_distance = distance;
  return now;
}

TEST(AuditoryDisplay, has_no_beacon_unless_asked_for) {
  EXPECT_EQ(count({}, Earcon::beacon, with_waypoint_in(5.0)), 0);
}

TEST(AuditoryDisplay, has_a_beacon_that_quickens_up_to_the_capture_radius) {
  sounds::SoundsConfig config;
  config.beacon.on = true;
  const int far = count(config, Earcon::beacon, with_waypoint_in(10.0));
  EXPECT_NEAR(far, 9, 1);
  EXPECT_GT(count(config, Earcon::beacon, with_waypoint_in(2.0)), 2 * far);
  EXPECT_EQ(count(config, Earcon::beacon, with_waypoint_in(1.4)), 0);
  EXPECT_EQ(count(config, Earcon::beacon, {}), 0);
}

}  // namespace
}  // namespace navvi_feedback::core
