#include "drive/assistance.hpp"

#include <gtest/gtest.h>

#include <navvi_config/reader.hpp>

namespace navvi_feedback::drive {
namespace {

using Things = std::vector<NearThing>;

NearThing at(double x, double y, double gap) { return {ThingClass::shelf, 1, gap, {x, y}, false}; }

Assistance assistance(const std::string& mode) {
  AssistanceConfig config;
  config.mode = mode;
  return Assistance(config);
}

TEST(Assistance, leaves_the_command_alone_unless_it_is_wanted) {
  EXPECT_EQ(assistance("off").share({0.9, 0.0}, {at(0.4, 0.0, 0.0)}, true), 1.0);
  EXPECT_EQ(assistance("off").share({0.9, 0.0}, {}, false), 1.0);
  EXPECT_THROW(
      {
        AssistanceConfig config;
        navvi_config::read(config, YAML::Load("{mode: steer}"), "test");
      },
      navvi_config::ConfigError);
}

TEST(Assistance, slows_or_stops_before_what_is_in_the_way_and_nothing_else) {
  const Things ahead = {at(0.5, 0.1, 0.1)};
  EXPECT_EQ(assistance("stop").share({0.9, 0.0}, ahead, true), 0.0);
  EXPECT_EQ(assistance("slow").share({0.9, 0.0}, ahead, true), 0.25);
  for (const char* mode : {"slow", "stop"}) {
    EXPECT_EQ(assistance(mode).share({-0.5, 0.0}, ahead, true), 1.0) << "away from it";
    EXPECT_EQ(assistance(mode).share({0.0, 1.0}, ahead, true), 1.0) << "a turn on the spot";
    EXPECT_EQ(assistance(mode).share({0.9, 0.0}, {at(0.5, 0.6, 0.1)}, true), 1.0) << "beside";
    EXPECT_EQ(assistance(mode).share({0.9, 0.0}, {at(3.0, 0.0, 2.5)}, true), 1.0) << "far";
    EXPECT_LT(assistance(mode).share({-0.5, 0.0}, {at(-0.6, 0.0, 0.2)}, true), 1.0) << "behind";
    EXPECT_EQ(assistance(mode).share({0.9, 0.0}, {}, false), 0.25) << "it sees nothing";
  }
}

TEST(Assistance, brings_a_robot_to_rest_before_a_shelf_from_any_speed) {
  const Assistance stops = assistance("stop");
  for (const double speed : {0.2, 0.5, 0.9, 1.5}) {
    double gap = 4.0;
    for (int tick = 0; tick < 2000; ++tick)
      gap -= 0.02 * speed * stops.share({speed, 0.0}, {at(0.35 + gap, 0.0, gap)}, true);
    EXPECT_GT(gap, 0.1) << speed;
    EXPECT_LT(gap, 0.25) << speed;
  }
}

}  // namespace
}  // namespace navvi_feedback::drive
