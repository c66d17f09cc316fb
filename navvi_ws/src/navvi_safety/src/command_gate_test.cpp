#include "navvi_safety/command_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <navvi_types/angles.hpp>

namespace navvi_safety {
namespace {

using navvi_types::kPi;
using navvi_types::Velocity;

constexpr double kStep = 0.02;  // s

/// A gate with a stick before it, and a clock that both hands advance together.
class Gate : public testing::Test {
 protected:
  /// \param each  of the beats, before the wheels are told
  void beat(double seconds, const std::function<void()>& each) {
    const int steps = static_cast<int>(std::lround(seconds / kStep));
    for (int i = 0; i < steps; ++i) {
      now_.wall += kStep;
      now_.sim += kStep;
      each();
      wheels_ = gate_.update(now_);
    }
  }
  void hold(double seconds, std::optional<Velocity> command) {
    beat(seconds, [&] { gate_.receive({command}, now_); });
  }
  /// As hold(), by a connection of the driver.
  void send(unsigned link, const Velocity& command, double seconds = kStep) {
    beat(seconds, [&] {
      ASSERT_TRUE(gate_.admit("/feedback_node", link));
      gate_.receive({command}, now_);
    });
  }
  /// As hold(), by a connection with that delay, s.
  void delayed(double seconds, const Velocity& command, double age) {
    beat(seconds, [&] { gate_.receive({command, age, ++seq_}, now_); });
  }
  void silence(double wall, double sim) {
    now_.wall += wall;
    now_.sim += sim;
    wheels_ = gate_.update(now_);
  }
  void start() {
    hold(0.4, Velocity{});
    hold(0.1, Velocity{1.0, 0.5});
  }

  Instant now_{100.0, 5.0};
  unsigned seq_ = 0;
  CommandGate gate_{CommandGateConfig{}};
  Velocity wheels_;
};

TEST_F(Gate, does_not_move_before_any_command) {
  silence(1.0, 1.0);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.state(), CommandGate::State::waiting);
}

TEST_F(Gate, does_not_move_for_a_stick_that_was_never_neutral) {
  for (const Velocity held : {Velocity{1.0, 0.0}, {0.03, 0.0}, {-0.03, 0.0}, {0.0, 0.03}, {0.0, -0.03}}) {
    hold(2.0, held);
    EXPECT_EQ(gate_.state(), CommandGate::State::waiting) << held.linear << ' ' << held.angular;
    EXPECT_EQ(wheels_.linear, 0.0);
    EXPECT_EQ(wheels_.angular, 0.0);
  }
  hold(0.4, Velocity{-0.02, 0.02});
  EXPECT_EQ(gate_.state(), CommandGate::State::running);
}

TEST_F(Gate, moves_after_the_stick_was_neutral) {
  start();
  EXPECT_EQ(wheels_.linear, 1.0);
  EXPECT_EQ(wheels_.angular, 0.5);
  EXPECT_EQ(gate_.state(), CommandGate::State::running);
}

TEST_F(Gate, stops_when_either_clock_says_the_command_is_old) {
  for (const auto& [wall, sim] : {std::pair{0.26, 0.0}, std::pair{0.0, 0.26}}) {
    start();
    ASSERT_EQ(wheels_.linear, 1.0);
    silence(wall, sim);
    EXPECT_EQ(wheels_.linear, 0.0);
    EXPECT_EQ(gate_.state(), CommandGate::State::stopped);
    EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_lost);
  }
}

TEST_F(Gate, is_outrun_by_a_simulation_that_is_faster_than_its_commands) {
  const auto after = [this](double wall, double sim) {
    return gate_.outrun({now_.wall + wall, now_.sim + sim});
  };
  EXPECT_FALSE(after(0.01, 0.23)) << "before any command";
  start();
  EXPECT_FALSE(after(0.01, 0.22)) << "a command each 20 ms, tenfold";
  EXPECT_TRUE(after(0.01, 0.23));
  EXPECT_TRUE(after(0.24, 0.23));
  EXPECT_FALSE(after(0.26, 0.23)) << "silence must stop the wheels";
  gate_.stop(CommandGate::Reason::driver_changed);
  hold(0.1, Velocity{1.0, 0.0});
  EXPECT_FALSE(after(0.01, 0.23)) << "wheels that stand";
}

TEST_F(Gate, S7_a_pause_of_ten_minutes_of_simulated_time_stops_nobody_who_is_heard) {
  start();
  for (double end = now_.wall + 600.0; now_.wall < end; now_.wall += kStep) {
    gate_.receive({Velocity{1.0, 0.5}}, now_);
    wheels_ = gate_.update(now_);
    ASSERT_EQ(gate_.state(), CommandGate::State::running) << now_.wall;
  }
  hold(0.1, Velocity{1.0, 0.5});
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, T1_stops_when_time_runs_backwards) {
  start();
  silence(0.02, -97.0);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::clock_jumped);
}

TEST_F(Gate, stops_when_it_is_asked_to_until_the_stick_was_neutral) {
  start();
  gate_.stop(CommandGate::Reason::clock_jumped);
  hold(1.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.drive_state(0).reason, CommandGate::Reason::clock_jumped);
  start();
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, C8_does_not_move_while_an_emergency_stop_lasts) {
  gate_.stop(CommandGate::Reason::emergency_stop);
  EXPECT_EQ(gate_.state(), CommandGate::State::stopped) << "also before the first command";
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::emergency_stop);
  start();
  // The stick is released in it, which counts for nothing, and pushed again.
  for (const double stick : {1.0, 0.0, 1.0}) {
    for (int i = 0; i < 50; ++i) {
      gate_.stop(CommandGate::Reason::emergency_stop);
      hold(kStep, Velocity{stick, 0.0});
      EXPECT_EQ(wheels_.linear, 0.0);
    }
    EXPECT_EQ(gate_.reason(), CommandGate::Reason::emergency_stop);
  }
  hold(1.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0) << "the stick was not neutral since";
  start();
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, that_never_ran_waits_where_the_clock_jumps) {
  gate_.stop(CommandGate::Reason::clock_jumped);
  EXPECT_EQ(gate_.state(), CommandGate::State::waiting);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::none);
}

TEST_F(Gate, M2_a_driver_by_another_connection_has_to_be_neutral_first) {
  send(1, {}, 0.4);
  send(1, {1.0, 0.0}, 0.1);
  ASSERT_EQ(wheels_.linear, 1.0);
  send(2, {1.0, 0.0}, 1.0);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::driver_changed);
  EXPECT_EQ(gate_.drive_state(0).intruder, "") << "the one before it is gone";
  send(2, {}, 0.4);
  send(2, {1.0, 0.0}, 0.1);
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, C5_two_live_connections_of_the_drivers_name_keep_the_wheels_still) {
  send(1, {}, 0.4);
  send(1, {1.0, 0.0}, 0.1);
  for (int i = 0; i < 100; ++i) {
    send(2, {});
    EXPECT_EQ(wheels_.linear, 0.0);
    send(1, {1.0, 0.0});
    EXPECT_EQ(wheels_.linear, 0.0);
  }
  EXPECT_EQ(gate_.drive_state(0).intruder, "/feedback_node");
  // The second goes.
  send(1, {1.0, 0.0}, 1.0);
  EXPECT_EQ(wheels_.linear, 0.0);
  send(1, {}, 0.4);
  send(1, {1.0, 0.0}, 0.1);
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, is_stopped_for_a_command_that_comes_too_late_without_an_update_before_it) {
  start();
  now_.wall += 0.3;
  now_.sim += 0.3;
  gate_.receive({Velocity{1.0, 0.0}}, now_);
  EXPECT_EQ(gate_.state(), CommandGate::State::stopped);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_lost);
  hold(1.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0);
}

TEST_F(Gate, stays_stopped_until_the_stick_was_neutral_long_enough) {
  start();
  silence(0.3, 0.3);
  hold(1.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0);
  hold(0.2, Velocity{});
  hold(0.1, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0) << "0.2 s of neutral stick are too few";
  hold(0.4, Velocity{});
  hold(0.1, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, C3_bad_commands_are_counted_and_extend_nothing) {
  start();
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [linear, angular] : {std::pair{nan, nan}, {inf, inf}, {-inf, -inf}, {1e308, 1e308}, {15.1, 25.1}, {-15.1, -25.1}}) {
    now_.wall += 0.01;
    now_.sim += 0.01;
    gate_.receive({Velocity{linear, 0.0}}, now_);
    gate_.receive({Velocity{0.0, angular}}, now_);
  }
  gate_.receive({}, now_);
  EXPECT_EQ(gate_.rejected(), 13u);
  EXPECT_EQ(gate_.update(now_).linear, 1.0) << "the last valid command is 60 ms old";
  hold(0.2, std::nullopt);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_invalid);
}

TEST_F(Gate, C9_a_command_from_the_future_is_rejected) {
  start();
  const unsigned before = gate_.rejected();
  delayed(0.3, Velocity{1.0, 0.0}, -0.31);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.rejected() - before, 15u);
}

TEST_F(Gate, the_same_delay_all_the_time_is_usual) {
  for (const double delay : {0.15, 0.5, 2.5}) {
    delayed(0.4, Velocity{}, delay);
    delayed(6.0, Velocity{1.0, 0.0}, delay);
    EXPECT_EQ(wheels_.linear, 1.0) << delay;
    EXPECT_EQ(gate_.late(), LinkMeter::Late::no);
    EXPECT_NEAR(gate_.link_state(0).round_trip, delay, 1e-9);
    EXPECT_NEAR(gate_.link_state(0).foresight, delay, 1e-9);
    silence(10.0, 10.0);
  }
}

TEST_F(Gate, a_delay_that_is_not_felt_changes_nothing) {
  delayed(6.0, Velocity{}, 0.08);
  EXPECT_EQ(gate_.link_state(0).foresight, 0.0);
}

TEST_F(Gate, C9_a_command_later_than_usual_drives_slowly_and_one_too_late_not_at_all) {
  delayed(6.0, Velocity{}, 0.2);
  delayed(0.1, Velocity{1.0, 1.0}, 0.45);
  EXPECT_EQ(wheels_.linear, 1.0);
  delayed(0.1, Velocity{1.0, 1.0}, 0.55);
  EXPECT_DOUBLE_EQ(wheels_.linear, 0.4);
  EXPECT_DOUBLE_EQ(wheels_.angular, 0.4);
  EXPECT_EQ(gate_.late(), LinkMeter::Late::slow);
  delayed(0.1, Velocity{1.0, 5.0}, 0.55);
  EXPECT_DOUBLE_EQ(wheels_.angular, 0.4 * CommandGateConfig{}.max_angular);
  delayed(0.2, Velocity{1.0, 1.0}, 1.25);
  EXPECT_DOUBLE_EQ(wheels_.linear, 0.4) << "the last that counted is 0.2 s old";
  delayed(0.1, Velocity{1.0, 1.0}, 1.25);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_lost);
}

TEST_F(Gate, C9_C10_a_burst_after_a_gap_never_drives) {
  for (const double gap : {0.3, 1.0, 5.0}) {
    delayed(6.0, Velocity{}, 0.1);
    delayed(1.0, Velocity{1.0, 0.0}, 0.1);
    ASSERT_EQ(wheels_.linear, 1.0);
    silence(gap, gap);
    // All that was held up comes at once: 0.4 s of a neutral stick among it.
    for (double age = 0.1 + gap; age > 0.1; age -= kStep) {
      const bool neutral = age < 0.1 + gap - 0.1 && age > 0.1 + gap - 0.5;
      gate_.receive({Velocity{neutral ? 0.0 : 1.0, 0.0}, age, ++seq_}, now_);
      EXPECT_EQ(gate_.update(now_).linear, 0.0) << gap << " " << age;
    }
    delayed(1.0, Velocity{1.0, 0.0}, 0.1);
    EXPECT_EQ(wheels_.linear, 0.0) << "the stick was not neutral since then";
  }
}

TEST_F(Gate, C9_a_command_that_a_later_one_overtook_does_not_count) {
  delayed(0.5, Velocity{}, 0.1);
  delayed(0.1, Velocity{1.0, 0.0}, 0.1);
  gate_.receive({Velocity{0.5, 0.0}, 0.1, seq_ - 24}, now_);
  EXPECT_EQ(gate_.update(now_).linear, 1.0);
  gate_.receive({Velocity{0.5, 0.0}, 0.1, seq_ - 25}, now_);
  EXPECT_EQ(gate_.update(now_).linear, 0.5) << "the person's side was started anew";
}

TEST(LinkMeter, counts_the_commands_that_never_came) {
  LinkMeter meter;
  for (unsigned seq = 1; seq <= 200; ++seq)
    if (seq % 4 != 0 || seq == 200) meter.add(0.1 + 0.01 * (seq % 2), seq, kStep * seq);
  const navvi_types::LinkState state = meter.state(7);
  EXPECT_NEAR(state.loss, 0.245, 1e-9);
  EXPECT_NEAR(state.round_trip_99, 0.11, 1e-9);
  EXPECT_GT(state.jitter, 0.004);
  EXPECT_EQ(state.stamp, 7);
  meter.add(0.1, 1, 10.0);
  EXPECT_EQ(meter.state(0).loss, 0.0) << "the person's side was started anew";
}

TEST(LinkMeter, has_the_figures_of_a_few_commands_by_hand) {
  LinkMeter meter;
  meter.add(0.1, 1, 0.0);
  EXPECT_EQ(meter.state(0).jitter, 0.0);
  meter.add(0.4, 2, 0.1);
  meter.add(0.2, 3, 0.2);
  EXPECT_NEAR(meter.state(0).jitter, 0.25, 1e-12);
  EXPECT_EQ(meter.state(0).round_trip, 0.2);
  EXPECT_EQ(meter.state(0).late, LinkMeter::Late::no);
  meter.add(0.6, 4, 0.3);
  EXPECT_EQ(meter.state(0).late, LinkMeter::Late::slow);
}

TEST_F(Gate, C4_a_command_beyond_the_limits_is_clamped) {
  hold(0.4, Velocity{});
  hold(kStep, Velocity{-9.0, 9.0});
  EXPECT_EQ(wheels_.linear, -1.5);
  EXPECT_EQ(wheels_.angular, 2.5);
  hold(kStep, Velocity{0.0, 9.0});
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(wheels_.angular, 2.5);
}

TEST_F(Gate, names_bad_commands_as_the_reason_only_where_none_was_good_since) {
  start();
  gate_.receive({std::nullopt}, now_);
  hold(kStep, Velocity{1.0, 0.0});
  silence(0.3, 0.3);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_lost);
}

TEST_F(Gate, what_was_neutral_before_a_stop_does_not_count_after_it) {
  start();
  hold(1.0, Velocity{});
  gate_.stop(CommandGate::Reason::emergency_stop);
  hold(0.2, Velocity{});
  EXPECT_EQ(gate_.state(), CommandGate::State::stopped);
  hold(0.2, Velocity{});
  EXPECT_EQ(gate_.state(), CommandGate::State::running);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::none);
}

TEST_F(Gate, the_stick_must_be_neutral_for_long_enough_by_both_clocks) {
  for (const auto& [wall, sim] : {std::pair{0.001, 0.02}, std::pair{0.02, 0.001}}) {
    CommandGate gate{CommandGateConfig{}};
    for (int i = 0; i < 40; ++i) {
      now_.wall += wall;
      now_.sim += sim;
      gate.receive({Velocity{}}, now_);
      EXPECT_EQ(gate.update(now_).linear, 0.0);
    }
    EXPECT_EQ(gate.state(), CommandGate::State::waiting);
  }
}

TEST_F(Gate, assistance_turns_no_faster_than_the_robot_may) {
  CommandGateConfig config;
  config.assistance = "steer";
  config.max_angular = 0.3;
  gate_ = CommandGate(config);
  hold(0.4, Velocity{});
  gate_.see({{navvi_types::ThingClass::box, 1, 0.65, {1.0, 0.0}}}, now_);
  hold(kStep, Velocity{0.9, 0.2});
  EXPECT_EQ(gate_.drive_state(0).assistance, navvi_types::DriveState::Assistance::steers_left);
  EXPECT_EQ(wheels_.angular, 0.3);
}

TEST(CommandGate, admits_the_one_driver_and_names_any_other) {
  CommandGateConfig config;
  config.driver = "/feedback_node";
  CommandGate gate{config};
  EXPECT_TRUE(gate.admit("/feedback_node", 1));
  EXPECT_EQ(gate.drive_state(0).intruder, "");
  EXPECT_FALSE(gate.admit("/teleop", 2));
  EXPECT_EQ(gate.drive_state(0).intruder, "/teleop");
  EXPECT_TRUE(gate.admit("/feedback_node", 1));
  EXPECT_EQ(gate.reason(), CommandGate::Reason::none) << "an ignored node stops nothing";
  EXPECT_TRUE(CommandGate(CommandGateConfig{}).admit("/teleop", 1)) << "no driver is named";
}

TEST_F(Gate, drives_no_faster_than_zones_allow_and_slowly_where_they_are_silent) {
  start();
  navvi_types::ZoneState zone;
  zone.forward = 0.3;
  zone.backward = 0.6;
  gate_.limit(zone, now_);
  hold(0.1, Velocity{1.0, 0.5});
  EXPECT_EQ(wheels_.linear, 0.3);
  EXPECT_EQ(wheels_.angular, 0.5) << "turning is free";
  hold(0.1, Velocity{-1.0, 0.0});
  EXPECT_EQ(wheels_.linear, -0.6);
  hold(0.5, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, CommandGateConfig::kZoneLost);
  gate_.limit({}, now_);
  hold(0.1, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 1.0);
  zone.forward = 0.0;
  gate_.limit(zone, now_);
  hold(2.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0) << "held at a border, it starts for no silence";
}

TEST_F(Gate, a_border_stays_where_it_was_when_zones_are_silent_and_the_robot_turns) {
  start();
  navvi_types::ZoneState zone;
  zone.forward = 0.0;
  gate_.limit(zone, now_);
  hold(0.6, Velocity{});
  hold(0.4, Velocity{0.0, 2.0});
  now_.sim += 10.0;  // of which the wheels turn for 0.25 s, until the command is old
  wheels_ = gate_.update(now_);
  hold(0.4, Velocity{});
  hold(0.1, Velocity{0.5, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0) << "before it still";
  hold(kPi / 2.0 - 0.65, Velocity{0.0, 2.0});
  hold(0.1, Velocity{0.5, 0.0});
  EXPECT_EQ(wheels_.linear, CommandGateConfig::kZoneLost) << "away from it";
  hold(0.1, Velocity{-0.5, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0) << "into it";
  hold(kPi / 2.0, Velocity{0.0, -2.0});
  hold(0.1, Velocity{0.5, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0) << "before it again";
}

}  // namespace
}  // namespace navvi_safety
