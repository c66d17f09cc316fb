#include "cues/leg.hpp"

#include <gtest/gtest.h>

#include "cues/clock_face.hpp"

namespace navvi_feedback::cues {
namespace {

Observation drives(double linear, double degrees, double offset) {
  Observation now;
  now.guidance.emplace();
  now.guidance->steer_angle = degrees * kDegree;
  now.guidance->path_offset = offset;
  now.measured = Velocity{linear, 0.0};
  return now;
}

TEST(Straying, is_the_wrong_way_only_of_a_robot_that_drives) {
  const StrayConfig config;
  EXPECT_EQ(straying(drives(0.5, -130.0, 0.0), {}, config), CueKind::wrong_way);
  EXPECT_EQ(straying(drives(0.5, 110.0, 0.0), {}, config), std::nullopt);
  EXPECT_EQ(straying(drives(0.05, 130.0, 0.0), {}, config), std::nullopt) << "about to turn";
  EXPECT_EQ(straying(drives(0.5, 130.0, 1.0), {}, config), CueKind::wrong_way) << "more urgent";
}

TEST(Straying, is_off_the_path_until_it_is_clearly_on_it) {
  const StrayConfig config;
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.6), {}, config), std::nullopt);
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.8), {}, config), CueKind::off_path);
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.6), CueKind::off_path, config), CueKind::off_path);
  EXPECT_EQ(straying(drives(0.5, 0.0, 0.3), CueKind::off_path, config), std::nullopt);
}

TEST(Stray, is_due_once_it_has_lasted_and_again_while_it_lasts) {
  const StrayConfig config;
  const Observation off = drives(0.5, 0.0, 1.0);
  Stray stray;
  stray.observe(off, config, 10.0);
  EXPECT_FALSE(stray.due(off, config, 11.4));
  EXPECT_TRUE(stray.due(off, config, 11.6));
  EXPECT_FALSE(stray.due(drives(0.0, 0.0, 1.0), config, 11.6)) << "it stands";
  stray.said = 11.6;
  EXPECT_FALSE(stray.due(off, config, 21.5));
  EXPECT_TRUE(stray.due(off, config, 21.7));
  stray.observe(drives(0.5, 170.0, 1.0), config, 22.0);
  EXPECT_FALSE(stray.due(off, config, 22.1)) << "another way to stray begins anew";
}

}  // namespace

}  // namespace navvi_feedback::cues
