#include "senses/foresight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

namespace navvi_feedback::senses {
namespace {

constexpr double kStep = 0.02;  // s
constexpr int kUp = 15, kDown = 10;  // steps, that a command and a report are under way
constexpr double kRoundTrip = kStep * (kUp + kDown);

/// A robot that does at once what it is told, at the other end of a slow connection.
class FarRobot : public testing::Test {
 protected:
  void send(const Velocity& command) {
    foresight_.sent(command, time_);
    commands_.push_back(command);
    reports_.push_back({robot_, velocity_});
    if (commands_.size() > kUp) {
      velocity_ = commands_.front();
      commands_.pop_front();
    }
    const double course = robot_.yaw + 0.5 * velocity_.angular * kStep;
    robot_.position +=
        velocity_.linear * kStep * Eigen::Vector2d(std::cos(course), std::sin(course));
    robot_.yaw += velocity_.angular * kStep;
    if (reports_.size() > kDown) reports_.pop_front();
    time_ += kStep;
  }
  void drive(double seconds, const Velocity& command) {
    for (double t = 0.0; t < seconds - 1e-9; t += kStep) send(command);
  }
  /// What the person's side knows now.
  [[nodiscard]] navvi_types::Pose2 seen() const { return reports_.front().first; }
  [[nodiscard]] navvi_types::Pose2 foreseen() const {
    return foresight_.place(seen(), kRoundTrip, time_);
  }

  Foresight foresight_;
  double time_ = 0.0;
  navvi_types::Pose2 robot_;
  Velocity velocity_;

 private:
  std::deque<Velocity> commands_;
  std::deque<std::pair<navvi_types::Pose2, Velocity>> reports_;
};

TEST_F(FarRobot, is_foreseen_where_it_will_be_when_the_next_command_arrives) {
  drive(2.0, {0.0, 0.0});
  drive(1.0, {0.9, 0.3});
  drive(0.3, {0.5, -0.8});
  const navvi_types::Pose2 foreseen = this->foreseen();
  drive(kStep * kUp, {0.0, 0.0});
  EXPECT_NEAR((foreseen.position - robot_.position).norm(), 0.0, 0.05);
  EXPECT_NEAR(foreseen.yaw, robot_.yaw, 0.05);
  EXPECT_GT((foreseen.position - seen().position).norm(), 0.08) << "and not where it was seen";
}

TEST_F(FarRobot, that_is_told_nothing_stays_where_it_was_seen) {
  drive(2.0, {0.9, 0.5});
  drive(2.0, {0.0, 0.0});
  EXPECT_NEAR((foreseen().position - robot_.position).norm(), 0.0, 1e-9);
  EXPECT_NEAR(foreseen().yaw, robot_.yaw, 1e-9);
}

TEST_F(FarRobot, has_the_speed_that_it_is_told_and_what_is_near_comes_nearer) {
  drive(2.0, {0.0, 0.0});
  drive(0.3, {0.9, 0.0});
  Observation now;
  now.measured = now.last_measured = Velocity{};
  now.nearby.resize(1);
  now.nearby[0].nearest = {2.0, 0.3};
  now.nearby[0].gap = 1.6;
  foresight_.look_ahead(now, std::nullopt, kRoundTrip, time_);
  EXPECT_NEAR(now.measured->linear, 0.9, 1e-9);
  EXPECT_NEAR(now.nearby[0].nearest.x(), 2.0 - 0.9 * 0.3, 0.03);
  EXPECT_NEAR(now.nearby[0].gap, 1.6 - 0.9 * 0.3, 0.04);
  now.measured = now.last_measured = Velocity{};
  drive(2.0, {0.9, 0.0});
  foresight_.look_ahead(now, std::nullopt, kRoundTrip, time_);
  EXPECT_NEAR(now.measured->linear, 0.0, 1e-9) << "it was told to drive long ago, and is held";
}

TEST_F(FarRobot, is_led_from_where_it_will_be) {
  drive(2.0, {0.0, 0.0});
  drive(0.4, {0.8, 0.0});
  drive(0.1, {0.0, 1.0});
  Observation now;
  now.guidance = Guidance{};
  now.guidance->state = Guidance::State::following;
  now.guidance->waypoint = {4.0, 0.0};
  now.guidance->waypoint_distance = 4.0;
  now.guidance->goal_distance = 9.0;
  foresight_.look_ahead(now, seen(), kRoundTrip, time_);
  const navvi_types::Pose2 ahead = foreseen();
  EXPECT_NEAR(now.guidance->waypoint_distance, 4.0 - 0.32, 0.03);
  EXPECT_NEAR(now.guidance->waypoint_angle, ahead.yaw, 0.02) << "clockwise, of a left turn";
  EXPECT_NEAR(now.guidance->steer_angle, ahead.yaw, 0.02);
  EXPECT_NEAR(now.guidance->goal_distance, 9.0 - 0.32, 0.03);
}

}  // namespace
}  // namespace navvi_feedback::senses
