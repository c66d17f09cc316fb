#include "senses/senses.hpp"

#include <gtest/gtest.h>

namespace navvi_feedback::senses {
namespace {

constexpr double kStale = 0.8;  // s

Guidance to(const Eigen::Vector2d& goal) {
  Guidance guidance;
  guidance.state = Guidance::State::following;
  guidance.goal = goal;
  return guidance;
}

TEST(Senses, know_nothing_before_the_first_message) {
  Senses senses(kStale);
  const Observation now = senses.observe({}, 0.02, 10.0);
  EXPECT_EQ(now.links.pad, Link::never);
  EXPECT_EQ(now.links.simulator, Link::never);
  EXPECT_EQ(now.links.proximity, Link::never);
  EXPECT_EQ(now.links.guidance, Link::never);
  EXPECT_FALSE(now.guidance || now.measured || now.gate || now.goal_angle || now.place);
  EXPECT_TRUE(now.nearby.empty() && now.contacts.empty() && now.notices.empty());
}

TEST(Senses, keep_a_stale_velocity_and_guidance_but_nothing_stale_that_is_near) {
  Senses senses(kStale);
  senses.take(to({5.0, 0.0}), 10.0);
  senses.take(Odometry{0, {}, {0.5, 0.0}}, 10.0);
  senses.take(Proximity{0, {{ThingClass::shelf, 1, 0.5, {0.9, 0.0}}}}, 10.0);
  Observation now = senses.observe({}, 0.02, 10.0 + kStale - 0.01);
  EXPECT_EQ(now.nearby.size(), 1U);
  EXPECT_EQ(now.motion().linear, 0.5);
  EXPECT_EQ(now.links.guidance, Link::alive);
  now = senses.observe({}, 0.02, 10.0 + kStale + 0.01);
  EXPECT_TRUE(now.nearby.empty());
  EXPECT_EQ(now.motion().linear, 0.0);
  EXPECT_EQ(now.last_measured.linear, 0.5);
  EXPECT_TRUE(now.guidance);
  EXPECT_EQ(now.links.guidance, Link::lost);
  EXPECT_EQ(now.links.simulator, Link::lost);
  EXPECT_EQ(now.links.proximity, Link::lost);
}

TEST(Senses, report_each_contact_once) {
  Senses senses(kStale);
  senses.take(Contact{ThingClass::shelf, {0.4, 0.0}, 7}, 10.0);
  EXPECT_EQ(senses.observe({}, 0.02, 10.0).contacts.size(), 1U);
  EXPECT_TRUE(senses.observe({}, 0.02, 10.02).contacts.empty());
}

TEST(Senses, turn_with_the_robot_from_one_guidance_to_the_next) {
  Senses senses(kStale);
  senses.take(to({5.0, 0.0}), 10.0);
  senses.take(Odometry{0, {}, {0.0, 0.5}}, 10.0);
  EXPECT_DOUBLE_EQ(senses.observe({}, 0.1, 10.0).turned, 0.05);
  EXPECT_DOUBLE_EQ(senses.observe({}, 0.1, 10.1).turned, 0.1);
  senses.take(to({5.0, 0.0}), 10.1);
  EXPECT_DOUBLE_EQ(senses.observe({}, 0.1, 10.2).turned, 0.05);
}

TEST(Senses, know_the_goal_and_the_smallest_place_about_a_robot_whose_pose_is_known) {
  Senses senses(kStale);
  senses.take(to({3.0, 1.0}), 10.0);
  Scenario scenario;
  scenario.places.resize(2);
  scenario.places[0].area = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(20.0, 20.0)};
  scenario.places[0].number = 1;
  scenario.places[1].area = {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(5.0, 5.0)};
  scenario.places[1].number = 2;
  senses.take(scenario, 10.0);
  EXPECT_FALSE(senses.observe({}, 0.02, 10.0).goal_angle);
  Devices devices;
  devices.robot = navvi_types::Pose2{{3.0, 4.0}, 0.0};
  const Observation now = senses.observe(devices, 0.02, 10.0);
  EXPECT_NEAR(now.goal_angle.value(), 1.5708, 1e-3) << "to the right";
  EXPECT_DOUBLE_EQ(now.goal_straight, 3.0);
  EXPECT_EQ(now.place.value().number, 2U);
}

TEST(Senses, miss_a_stick_only_after_there_was_one) {
  Senses senses(kStale);
  Devices devices;
  EXPECT_EQ(senses.observe(devices, 0.02, 10.0).links.pad, Link::never);
  devices.hands.live = true;
  EXPECT_EQ(senses.observe(devices, 0.02, 10.02).links.pad, Link::alive);
  devices.hands.live = false;
  EXPECT_EQ(senses.observe(devices, 0.02, 10.04).links.pad, Link::lost);
}

TEST(Senses, report_a_record_that_is_lost_while_a_trial_runs_if_it_was_repeated_before) {
  Senses senses(kStale);
  const TrialState running{TrialState::State::running};
  senses.take(running, 10.0);
  EXPECT_TRUE(senses.observe({}, 0.02, 15.0).notices.empty()) << "one that does not repeat it";
  senses.take(running, 15.0);
  EXPECT_TRUE(senses.observe({}, 0.02, 16.9).notices.empty());
  EXPECT_EQ(senses.observe({}, 0.02, 17.1).notices, std::vector<Content>{CueKind::record_lost});
}

}  // namespace
}  // namespace navvi_feedback::senses
