#include "navvi_safety/command_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace navvi_safety {
namespace {

using navvi_types::Velocity;

constexpr double kStep = 0.02;  // s

/// A gate with a stick before it, and a clock that both hands advance together.
class Gate : public testing::Test {
 protected:
  void hold(double seconds, std::optional<Velocity> command) {
    const int steps = static_cast<int>(std::lround(seconds / kStep));
    for (int i = 0; i < steps; ++i) {
      now_.wall += kStep;
      now_.sim += kStep;
      gate_.receive(command, now_);
      wheels_ = gate_.update(now_);
    }
  }
  /// As hold(), by a connection of the driver.
  void send(unsigned link, const Velocity& command, double seconds = kStep) {
    const int steps = static_cast<int>(std::lround(seconds / kStep));
    for (int i = 0; i < steps; ++i) {
      now_.wall += kStep;
      now_.sim += kStep;
      ASSERT_TRUE(gate_.admit("/feedback_node", link, now_));
      gate_.receive(command, now_);
      wheels_ = gate_.update(now_);
    }
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
  CommandGate gate_{CommandGateConfig{}};
  Velocity wheels_;
};

TEST_F(Gate, does_not_move_before_any_command) {
  silence(1.0, 1.0);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.state(), CommandGate::State::waiting);
}

TEST_F(Gate, does_not_move_for_a_stick_that_was_never_neutral) {
  hold(2.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0);
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

TEST_F(Gate, S7_a_pause_of_ten_minutes_of_simulated_time_stops_nobody_who_is_heard) {
  start();
  for (double end = now_.wall + 600.0; now_.wall < end; now_.wall += kStep) {
    gate_.receive(Velocity{1.0, 0.5}, now_);
    wheels_ = gate_.update(now_);
    ASSERT_EQ(gate_.state(), CommandGate::State::running) << now_.wall;
  }
  hold(0.1, Velocity{1.0, 0.5});
  EXPECT_EQ(wheels_.linear, 1.0);
}

TEST_F(Gate, S7_after_a_halt_of_ten_minutes_it_moves_only_once_the_stick_was_neutral) {
  start();
  silence(600.0, 0.0);
  EXPECT_EQ(wheels_.linear, 0.0);
  for (int i = 0; i < 250; ++i) {
    hold(kStep, Velocity{1.0, 0.0});
    ASSERT_EQ(wheels_.linear, 0.0);
  }
  hold(0.4, Velocity{});
  hold(0.1, Velocity{1.0, 0.0});
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

TEST_F(Gate, that_never_ran_waits_whatever_it_is_asked) {
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
  gate_.receive(Velocity{1.0, 0.0}, now_);
  EXPECT_EQ(gate_.state(), CommandGate::State::stopped);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_lost);
  hold(1.0, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 0.0);
  hold(0.4, Velocity{});
  hold(0.1, Velocity{1.0, 0.0});
  EXPECT_EQ(wheels_.linear, 1.0);
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

TEST_F(Gate, bad_commands_are_counted_and_extend_nothing) {
  start();
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, inf, -inf, 1e308}) {
    now_.wall += kStep;
    now_.sim += kStep;
    gate_.receive(Velocity{bad, 0.0}, now_);
    gate_.receive(Velocity{0.0, bad}, now_);
  }
  gate_.receive(std::nullopt, now_);
  EXPECT_EQ(gate_.rejected(), 9u);
  EXPECT_EQ(gate_.update(now_).linear, 1.0) << "the last valid command is 80 ms old";
  hold(0.2, std::nullopt);
  EXPECT_EQ(wheels_.linear, 0.0);
  EXPECT_EQ(gate_.reason(), CommandGate::Reason::command_invalid);
}

TEST_F(Gate, a_command_beyond_the_limits_is_clamped_and_counted) {
  hold(0.4, Velocity{});
  hold(kStep, Velocity{-9.0, 9.0});
  EXPECT_EQ(wheels_.linear, -1.5);
  EXPECT_EQ(wheels_.angular, 2.5);
  EXPECT_EQ(gate_.clamped(), 1u);
}

TEST(CommandGate, admits_the_one_driver_and_names_any_other) {
  CommandGateConfig config;
  config.driver = "/feedback_node";
  CommandGate gate{config};
  EXPECT_TRUE(gate.admit("/feedback_node", 1, {}));
  EXPECT_EQ(gate.drive_state(0).intruder, "");
  EXPECT_FALSE(gate.admit("/teleop", 2, {}));
  EXPECT_EQ(gate.drive_state(0).intruder, "/teleop");
  EXPECT_TRUE(gate.admit("/feedback_node", 1, {}));
  EXPECT_EQ(gate.reason(), CommandGate::Reason::none) << "an ignored node stops nothing";
  EXPECT_TRUE(CommandGate(CommandGateConfig{}).admit("/teleop", 1, {})) << "no driver is named";
}

}  // namespace
}  // namespace navvi_safety
