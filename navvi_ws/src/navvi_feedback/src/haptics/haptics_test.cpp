#include "haptics/haptics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <navvi_config/reader.hpp>

#include "haptics/rumble_output.hpp"

namespace navvi_feedback::haptics {
namespace {

constexpr double kStep = 0.02;  // s
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

HapticsConfig paper() {
  const std::string file = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/paper.yaml";
  HapticsConfig config;
  navvi_config::read(config, navvi_config::load_yaml(file)["haptics"], file);
  return config;
}

NearThing thing(double gap, double x, double y, ThingClass thing_class = ThingClass::box) {
  NearThing result;
  result.thing_class = thing_class;
  result.gap = gap;
  result.nearest = {x, y};
  return result;
}

Rumble settle(Haptics& haptics, const std::vector<NearThing>& things, double seconds = 3.0) {
  Rumble rumble;
  for (int i = 0; i < std::lround(seconds / kStep); ++i)
    rumble = haptics.update(things, true, kStep);
  return rumble;
}

TEST(Haptics, the_paper_law_is_the_formula_as_printed) {
  for (double d = 0.0; d < 5.0; d += 0.1)
    EXPECT_NEAR(rumble_force(paper(), d), std::log(1.0 + (1.0 - d / 5.0)), 1e-12);
  EXPECT_NEAR(rumble_force(paper(), 0.0), 0.693, 1e-3);
}

TEST(Haptics, the_paper_profile_gives_the_bare_formula_at_once_of_the_nearest_thing) {
  Haptics haptics(paper());
  const Rumble rumble = haptics.update({thing(2.0, 2.0, 1.5)}, true, kStep);
  EXPECT_NEAR(rumble.left, std::log(1.6), 1e-12);
  EXPECT_EQ(rumble.right, 0.0);
  const Rumble nearest = settle(haptics, {thing(3.0, 0.0, 3.5), thing(1.0, 0.0, -1.5)});
  EXPECT_EQ(nearest.left, 0.0);
  EXPECT_NEAR(nearest.right, std::log(1.8), 1e-12);
}

TEST(Haptics, every_curve_falls_from_one_at_touch_to_zero_at_the_range) {
  HapticsConfig config;
  for (const char* curve : {"log", "linear", "power"}) {
    config.curve = curve;
    EXPECT_NEAR(rumble_force(config, 0.0), 1.0, 1e-12) << curve;
    EXPECT_NEAR(rumble_force(config, -0.1), 1.0, 1e-12) << curve;
    EXPECT_EQ(rumble_force(config, config.range), 0.0) << curve;
    EXPECT_EQ(rumble_force(config, 99.0), 0.0) << curve;
    double last = 1.0;
    for (double gap = 0.0; gap < 6.0; gap += 0.01) {
      EXPECT_LE(rumble_force(config, gap), last) << curve;
      last = rumble_force(config, gap);
    }
  }
}

TEST(Haptics, shelves_walls_and_gaps_that_are_not_finite_are_not_felt) {
  EXPECT_EQ(rumble_force(HapticsConfig{}, kNan), 0.0);
  for (const NearThing& unfelt :
       {thing(kNan, 1.0, 2.0), thing(1.0, kNan, kNan), thing(0.1, 0.5, 0.0, ThingClass::shelf),
        thing(0.1, 0.5, 0.0, ThingClass::wall)}) {
    Haptics haptics{HapticsConfig{}};
    const Rumble rumble = settle(haptics, {unfelt});
    EXPECT_EQ(rumble.left + rumble.right, 0.0) << to_string(unfelt.thing_class);
  }
  HapticsConfig config;
  config.classes = {"dragon"};
  EXPECT_THROW(Haptics{config}, navvi_config::ConfigError);
}

TEST(Haptics, the_motor_is_on_the_side_of_the_thing) {
  struct Row {
    double y;
    bool left, right;
  };
  for (const Row& row : {Row{1.5, true, false}, Row{-1.5, false, true}, Row{0.9, true, true},
                         Row{-0.9, true, true}, Row{0.0, true, true}}) {
    Haptics haptics(paper());
    const Rumble rumble = settle(haptics, {thing(1.0, 1.0, row.y)});
    EXPECT_EQ(rumble.left > 0.0, row.left) << row.y;
    EXPECT_EQ(rumble.right > 0.0, row.right) << row.y;
  }
}

TEST(Haptics, a_mirrored_world_feels_mirrored) {
  HapticsConfig config;
  config.start_right = config.start_left;
  for (double y = 0.05; y < 4.0; y += 0.1) {
    Haptics one(config);
    Haptics other(config);
    const Rumble here = settle(one, {thing(1.0, 1.0, y)});
    const Rumble there = settle(other, {thing(1.0, 1.0, -y)});
    EXPECT_EQ(here.left, there.right) << y;
    EXPECT_EQ(here.right, there.left) << y;
  }
}

TEST(Haptics, what_is_ahead_is_felt_before_what_rides_behind) {
  Haptics haptics((HapticsConfig()));
  const Rumble behind = settle(haptics, {thing(0.5, -0.9, 0.0)});
  const Rumble ahead = settle(haptics, {thing(0.5, 0.9, 0.0)});
  EXPECT_LT(behind.left, 0.4);
  EXPECT_GT(ahead.left, 0.7);
  const Rumble both = settle(haptics, {thing(0.5, -0.9, 0.0), thing(1.0, 0.5, 1.3)});
  EXPECT_GT(both.left, 0.4);
  EXPECT_EQ(both.right, 0.0) << "the one ahead on the left";
}

TEST(Haptics, stale_sensing_stops_the_motors_at_once) {
  Haptics haptics{HapticsConfig{}};
  EXPECT_GT(settle(haptics, {thing(0.2, 0.5, 0.0)}).left, 0.5);
  const Rumble rumble = haptics.update({thing(0.2, 0.5, 0.0)}, false, kStep);
  EXPECT_EQ(rumble.left, 0.0);
  EXPECT_EQ(rumble.right, 0.0);
}

TEST(Haptics, the_onset_is_a_ramp_and_no_jolt) {
  const HapticsConfig config;
  Haptics haptics(config);
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Rumble rumble = haptics.update({thing(0.1, 0.5, 0.0)}, true, kStep);
    EXPECT_LE(rumble.left - last, config.start_left + config.slew * kStep + 1e-12);
    last = rumble.left;
  }
  EXPECT_GT(last, 0.9);
}

TEST(Haptics, a_change_begins_with_the_message_that_asks_for_it_however_soon_that_comes) {
  const HapticsConfig config;
  Haptics haptics(config);
  RumbleOutput output;
  const auto moved = [&](double gap, double dt, double time) {
    return output.update(haptics.update({thing(gap, gap, 0.0)}, true, dt), time).moved;
  };
  EXPECT_TRUE(moved(3.0, 0.0, 0.0));
  for (int i = 1; i < 100; ++i) (void)moved(3.0, 0.02, 0.02 * i);
  EXPECT_FALSE(moved(3.0, 0.02, 2.0));
  EXPECT_TRUE(moved(1.0, 0.0, 2.0)) << "at the same moment as the last beat";
}

TEST(Haptics, a_thing_that_trembles_on_the_range_is_felt_steadily_or_not_at_all) {
  Haptics haptics{HapticsConfig{}};
  int changes = 0;
  bool felt = false;
  for (int i = 0; i < 500; ++i) {
    const bool was_felt = felt;
    felt = haptics.update({thing(4.98 + 0.04 * (i % 2), 1.0, 0.0)}, true, kStep).left > 0.0;
    if (felt != was_felt) ++changes;
  }
  EXPECT_LE(changes, 1);
}

TEST(Haptics, a_thing_that_trembles_on_a_border_keeps_its_zone) {
  HapticsConfig config;
  config.slew = 0.0;  // a motor that is left is off at once
  for (const double border : {1.0, -1.0}) {
    Haptics haptics(config);
    const auto sides = [&](double lateral) {
      const Rumble felt = haptics.update({thing(1.0, 1.0, lateral)}, true, kStep);
      return std::pair(felt.left > 0.0, felt.right > 0.0);
    };
    for (int i = 0; i < 50; ++i) (void)sides(border);
    const auto first = sides(border);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(sides(border + (i % 2 ? 0.05 : -0.05)), first);
  }
}

TEST(Haptics, a_motor_that_turns_gets_at_least_its_starting_threshold) {
  HapticsConfig config;
  EXPECT_GT(rumble_force(config, 0.0) - rumble_force(config, 1.0), 0.3) << "the last metre";
  config.start_left = 0.2;
  config.gain_left = 0.8;
  Haptics haptics(config);
  const Rumble faint = settle(haptics, {thing(4.8, 0.0, 4.9)});
  EXPECT_GE(faint.left, 0.2);
  Haptics other(config);
  EXPECT_NEAR(settle(other, {thing(0.0, 0.35, 0.0)}).left, 0.8, 1e-9);
}

TEST(Haptics, every_output_is_in_zero_to_one) {
  Haptics haptics{HapticsConfig{}};
  for (int i = 0; i < 3000; ++i) {
    const double gap = 6.0 * std::abs(std::sin(0.37 * i)) - 0.5;
    const Rumble rumble =
        haptics.update({thing(gap, 1.0, 3.0 * std::sin(0.11 * i))}, i % 50 != 0, kStep);
    for (const double value : {rumble.left, rumble.right}) {
      EXPECT_GE(value, 0.0);
      EXPECT_LE(value, 1.0);
    }
  }
}

TEST(RumbleOutput, records_slow_changes_twenty_times_a_second_and_jumps_and_stops_at_once) {
  RumbleOutput output;
  int records = 0;
  for (int i = 0; i < 100; ++i) {
    if (output.update({0.1 + 0.008 * i, 0.0}, i * 0.01).changed) ++records;
  }
  EXPECT_GE(records, 15);
  EXPECT_LE(records, 21);
  EXPECT_TRUE(output.update({0.5, 0.0}, 1.001).changed);
  EXPECT_TRUE(output.update({0.0, 0.0}, 1.002).changed);
  EXPECT_FALSE(output.update({0.0, 0.0}, 1.003).changed);
}

TEST(RumbleOutput, sends_each_change_at_once) {
  RumbleOutput output;
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(output.update({0.1 + 0.008 * i, 0.0}, i * 0.001).feedback) << i;
  EXPECT_FALSE(output.update({0.1 + 0.008 * 99, 0.0}, 0.1).feedback);
}

TEST(RumbleOutput, repeats_the_values_for_drivers_without_memory) {
  RumbleOutput output;
  int sent = 0;
  for (int i = 0; i < 50; ++i) {
    if (output.update({}, i * 0.02).feedback) ++sent;
  }
  EXPECT_GE(sent, 9);
  EXPECT_LE(sent, 11);
}

}  // namespace
}  // namespace navvi_feedback::haptics
