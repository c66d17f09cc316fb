#include "batch/turn_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_study::batch {
namespace {

constexpr double kStep = 0.02;  // s

/// Turns on the spot towards where it is led, and stops some degrees before or after it.
class TurnFiguresOf : public testing::Test {
 protected:
  void turn(double degrees, double too_far, double forward = 0.0) {
    const double angle = degrees * M_PI / 180.0;
    for (double off = angle; off > -too_far * M_PI / 180.0; off -= kStep) {
      figures_.watch(-1.0, forward, off, time_);
      time_ += kStep;
    }
    rest(1.0, -too_far * M_PI / 180.0);
  }
  void rest(double seconds, double off) {
    for (const double end = time_ + seconds; time_ < end; time_ += kStep)
      figures_.watch(0.0, 0.0, off, time_);
  }
  [[nodiscard]] record::Fields row() const {
    record::Fields row;
    figures_.add_to(row);
    return row;
  }

  TurnFigures figures_;
  double time_ = 0.0;  // s
};

TEST_F(TurnFiguresOf, a_trial_without_a_turn_knows_of_none) {
  rest(5.0, 0.3);
  EXPECT_EQ(row().get("led_turns"), "0");
  EXPECT_EQ(row().get("residual"), "n/a");
  EXPECT_EQ(row().get("cue_to_action"), "n/a");
}

TEST_F(TurnFiguresOf, what_turns_leave_is_told_by_median_and_tail) {
  for (const double too_far : {2.0, 6.0, 40.0}) turn(90.0, too_far);
  EXPECT_EQ(row().get("led_turns"), "3");
  EXPECT_NEAR(row().number("residual").value(), 6.0, 1.5);
  EXPECT_NEAR(row().number("residual_90").value(), 33.0, 2.0);
}

TEST_F(TurnFiguresOf, a_slight_turn_and_a_bend_driven_along_are_no_turn_on_the_spot) {
  turn(8.0, 0.0);
  turn(90.0, 0.0, 0.8);
  EXPECT_EQ(row().get("led_turns"), "0");
}

TEST_F(TurnFiguresOf, a_cue_counts_until_the_robot_turns) {
  figures_.ask(time_);
  rest(0.9, 1.5);
  figures_.ask(time_);
  turn(90.0, 0.0);
  EXPECT_NEAR(row().number("cue_to_action").value(), 0.9, 0.05);
  figures_.ask(time_);
  rest(9.0, 1.5);
  turn(90.0, 0.0);
  EXPECT_NEAR(row().number("cue_to_action").value(), 0.9, 0.05) << "not done for that cue";
}

}  // namespace
}  // namespace navvi_study::batch
