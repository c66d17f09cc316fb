#include "navvi_types/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>
#include <utility>

#include "fuzz_message.hpp"
#include "navvi_types/limits.hpp"

namespace navvi_types {
namespace {

constexpr std::int64_t kStamp = 12'000'000'345;

/// A number of a message, and the values next to its range that it must not have.
template <typename Msg>
struct Leaf {
  double& (*in)(Msg&);
  std::vector<double> beyond;
};

/// The ends of [-limit, limit], overstepped.
std::vector<double> beyond(double limit) { return {-1.001 * limit, 1.001 * limit}; }
/// Of [0, limit].
std::vector<double> beyond_from_0(double limit) { return {-1e-3, 1.001 * limit}; }

/// The sound message is taken; with any one number spoilt it is dropped whole.
template <typename Msg>
void expect_each_checked(const Msg& sound, const std::vector<Leaf<Msg>>& leaves) {
  ASSERT_TRUE(from_msg(sound).has_value());
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    std::vector<double> bad = leaves[i].beyond;
    bad.insert(bad.end(),
               {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), 1e308});
    for (const double value : bad) {
      Msg msg = sound;
      leaves[i].in(msg) = value;
      EXPECT_FALSE(from_msg(msg).has_value()) << "number " << i << ", value " << value;
    }
  }
}

#define LEAF(Msg, member) [](Msg& m) -> double& { return m.member; }

template <typename Msg>
void expect_same_after_round_trip(const Msg& msg) {
  const auto value = from_msg(msg);
  ASSERT_TRUE(value.has_value());
  EXPECT_EQ(to_msg(*value), msg);
}

geometry_msgs::Quaternion heading(double yaw) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(0.5 * yaw);
  q.w = std::cos(0.5 * yaw);
  return q;
}

std_msgs::Header header(const char* frame) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = from_ns(kStamp);
  return header;
}

geometry_msgs::Twist twist() {
  geometry_msgs::Twist msg;
  msg.linear.x = 0.5;
  msg.angular.z = -0.25;
  return msg;
}

nav_msgs::Odometry odometry() {
  nav_msgs::Odometry msg;
  msg.header = header("odom");
  msg.child_frame_id = "base_link";
  msg.pose.pose.position.x = 3.0;
  msg.pose.pose.position.y = -2.0;
  msg.pose.pose.position.z = 0.1;
  msg.pose.pose.orientation = heading(0.5);
  msg.twist.twist = twist();
  msg.twist.twist.linear.y = 0.125;
  return msg;
}

navvi_msgs::Proximity proximity() {
  navvi_msgs::Proximity msg;
  msg.header = header("base_link");
  msg.detection_radius = 5.0;
  navvi_msgs::ProximityThing& thing = msg.things.emplace_back();
  thing.id = 7;
  thing.name = "robot_3";
  thing.thing_class = "pallet_robot";
  thing.moving = true;
  thing.gap = 1.25;
  thing.nearest.x = 1.0;
  thing.nearest.y = -0.5;
  thing.nearest.z = 0.3;
  return msg;
}

navvi_msgs::Contact contact() {
  navvi_msgs::Contact msg;
  msg.header = header("map");
  msg.seq = 4;
  msg.id = 12;
  msg.name = "rack_2";
  msg.thing_class = "shelf";
  msg.point.x = 1.65;
  msg.point.y = 3.0;
  msg.point.z = 0.2;
  msg.robot.position.x = 2.0;
  msg.robot.position.y = 3.0;
  msg.robot.orientation = heading(0.5);
  msg.speed = 0.7;
  for (const char* thing_class : {"shelf", "worker"}) {
    navvi_msgs::ClassCount& entry = msg.counts.emplace_back();
    entry.thing_class = thing_class;
    entry.count = 2;
  }
  return msg;
}

navvi_msgs::Obstacles obstacles() {
  navvi_msgs::Obstacles msg;
  msg.header = header("map");
  navvi_msgs::Obstacle& thing = msg.obstacles.emplace_back();
  thing.id = 9;
  thing.thing_class = "forklift";
  thing.pose.position.x = 1.0;
  thing.pose.position.y = 2.0;
  thing.pose.orientation = heading(0.5);
  thing.velocity.x = 1.5;
  thing.velocity.y = -0.5;
  thing.radius = 1.3;
  thing.height = 2.2;
  thing.length = 2.4;
  thing.width = 1.0;
  return msg;
}

navvi_msgs::Guidance guidance() {
  navvi_msgs::Guidance msg;
  msg.header = header("map");
  msg.seq = 9;
  msg.state = navvi_msgs::Guidance::BLOCKED;
  msg.refusal = navvi_msgs::Guidance::OFF_THE_MAP;
  msg.replan_reason = navvi_msgs::Guidance::PERIOD;
  msg.plans = 5;
  msg.plan_time = 0.01;
  msg.reroutes = 2;
  msg.reroute_reason = navvi_msgs::Guidance::PATH_CARVED;
  msg.mesh_age = 0.1;
  msg.map_age = 60.0;
  msg.blocked_by = "worker";
  msg.blocked_distance = 1.5;
  msg.blocked_for = 3.0;
  msg.goal.x = 6.0;
  msg.waypoint.y = 2.0;
  msg.goal.z = msg.waypoint.z = 0.1;
  msg.ends_short = true;
  msg.waypoint_is_goal = true;
  msg.waypoint_distance = 2.0;
  msg.waypoint_angle = -1.5;
  msg.steer_angle = -1.25;
  msg.turn_angle = 1.0;
  msg.goal_distance = 8.0;
  msg.eta = 11.0;
  msg.shortest_length = 7.5;
  msg.path_offset = 0.25;
  msg.detail = "blocked";
  return msg;
}

navvi_msgs::Cue cue() {
  navvi_msgs::Cue msg;
  msg.header = header("");
  msg.id = 5;
  msg.stage = navvi_msgs::Cue::CUT;
  msg.modality = navvi_msgs::Cue::RUMBLE;
  msg.priority = navvi_msgs::Cue::MESSAGE;
  msg.kind = "rumble";
  msg.text = "stuck, shelf ahead";
  msg.left = 0.5F;
  msg.right = 1.0F;
  return msg;
}

navvi_msgs::Scenario scenario() {
  navvi_msgs::Scenario msg;
  msg.header = header("map");
  msg.world = "busy";
  msg.world_hash = "0123456789abcdef";
  msg.seed = 301;
  msg.start.position.x = -4.0;
  msg.start.orientation = heading(0.5);
  msg.goal.x = 4.0;
  msg.goal.y = 1.0;
  msg.parameters = "world: busy";
  msg.places.resize(1);
  msg.places[0].kind = navvi_msgs::Place::AISLE;
  msg.places[0].number = 2;
  msg.places[0].at.x = 0.5;
  msg.places[0].high.x = 1.0;
  msg.places[0].high.y = 8.0;
  return msg;
}

navvi_msgs::StateHash state_hash() {
  navvi_msgs::StateHash msg;
  msg.header = header("map");
  msg.step = 100;
  msg.hash = "00f3456789abcdef";
  return msg;
}

navvi_msgs::DriveState drive_state() {
  navvi_msgs::DriveState msg;
  msg.header = header("");
  msg.state = navvi_msgs::DriveState::STOPPED;
  msg.reason = navvi_msgs::DriveState::COMMAND_INVALID;
  msg.assistance = navvi_msgs::DriveState::STEERS_LEFT;
  msg.rejected = 3;
  msg.intruder = "/teleop";
  return msg;
}

navvi_msgs::LinkState link_state() {
  navvi_msgs::LinkState msg;
  msg.header = header("");
  msg.round_trip = 0.2;
  msg.round_trip_99 = 0.4;
  msg.jitter = 0.03;
  msg.loss = 0.01;
  msg.foresight = 0.2;
  msg.late = navvi_msgs::LinkState::SLOW;
  return msg;
}

TEST(MsgConversion, EveryMessageSurvivesTheRoundTrip) {
  expect_same_after_round_trip(twist());
  expect_same_after_round_trip(odometry());
  expect_same_after_round_trip(proximity());
  expect_same_after_round_trip(contact());
  expect_same_after_round_trip(obstacles());
  expect_same_after_round_trip(guidance());
  expect_same_after_round_trip(cue());
  expect_same_after_round_trip(scenario());
  expect_same_after_round_trip(state_hash());
  expect_same_after_round_trip(drive_state());
  expect_same_after_round_trip(link_state());
  navvi_msgs::TrialState state;
  state.state = navvi_msgs::TrialState::READY;
  expect_same_after_round_trip(state);
  navvi_msgs::TrialRequest request;
  request.request = navvi_msgs::TrialRequest::END;
  expect_same_after_round_trip(request);
}

/// What is taken is sent on, and taken there.
template <typename Msg>
void fuzz_round_trip(const Msg& whole) {
  navvi_test::fuzz_message(whole, [](const Msg& msg) {
    const auto value = from_msg(msg);
    if (!value) return;
    const Msg again = to_msg(*value);
    const auto same = from_msg(again);
    ASSERT_TRUE(same.has_value());
    EXPECT_EQ(navvi_test::bytes_of(to_msg(*same)).size(), navvi_test::bytes_of(again).size());
  });
}

TEST(FuzzMessages, C3_are_taken_or_dropped_and_taken_again_when_they_are_sent_on) {
  fuzz_round_trip(twist());
  fuzz_round_trip(odometry());
  fuzz_round_trip(proximity());
  fuzz_round_trip(contact());
  fuzz_round_trip(obstacles());
  fuzz_round_trip(guidance());
  fuzz_round_trip(cue());
  fuzz_round_trip(scenario());
  fuzz_round_trip(state_hash());
  fuzz_round_trip(drive_state());
  fuzz_round_trip(link_state());
  fuzz_round_trip(navvi_msgs::Zone());
  fuzz_round_trip(navvi_msgs::TrialState());
  fuzz_round_trip(navvi_msgs::TrialRequest());
}

TEST(FuzzMessages, C3_of_places_are_finite_where_they_are_taken) {
  geometry_msgs::PoseStamped pose;
  pose.pose.orientation = heading(0.5);
  const auto is_finite = [](const auto& msg) {
    const auto at = from_msg(msg);
    EXPECT_TRUE(!at || at->allFinite());
  };
  navvi_test::fuzz_message(pose, is_finite);
  navvi_test::fuzz_message(geometry_msgs::PointStamped(), is_finite);
  nav_msgs::Path path;
  path.poses = {pose, pose};
  navvi_test::fuzz_message(path, [](const nav_msgs::Path& msg) {
    for (const Eigen::Vector2d& point : from_msg(msg).value_or(std::vector<Eigen::Vector2d>()))
      EXPECT_TRUE(point.allFinite());
  });
  geometry_msgs::Transform transform;
  transform.rotation = heading(0.5);
  navvi_test::fuzz_message(transform, [](const geometry_msgs::Transform& msg) {
    const auto at = from_msg(msg);
    EXPECT_TRUE(!at || std::isfinite(at->position.sum() + at->yaw));
  });
}

TEST(MsgConversion, WhatIsNotKnownSurvivesTheRoundTrip) {
  navvi_msgs::Guidance msg = guidance();
  msg.mesh_age = msg.map_age = msg.blocked_for = -1.0;
  msg.blocked_by.clear();
  expect_same_after_round_trip(msg);
  msg.blocked_for = 0.0;
  expect_same_after_round_trip(msg);
  EXPECT_EQ(to_msg(Guidance{}).blocked_for, 0.0);
  EXPECT_EQ(to_msg(Guidance{}).map_age, -1.0);
}

TEST(MsgConversion, EmptyListsSurviveTheRoundTrip) {
  navvi_msgs::Proximity near = proximity();
  near.things.clear();
  expect_same_after_round_trip(near);
  expect_same_after_round_trip([] {
    navvi_msgs::Obstacles none = obstacles();
    none.obstacles.clear();
    return none;
  }());
  EXPECT_TRUE(from_msg(nav_msgs::Path())->empty());
  EXPECT_TRUE(path_msg({}, 0.0, kStamp).poses.empty());
}

TEST(MsgConversion, C3_EveryNumberOfATwistIsChecked) {
  using Msg = geometry_msgs::Twist;
  expect_each_checked<Msg>(twist(), {{LEAF(Msg, linear.x), beyond(kFastest)},
                                     {LEAF(Msg, linear.y), beyond(kFastest)},
                                     {LEAF(Msg, linear.z), beyond(kFastest)},
                                     {LEAF(Msg, angular.x), beyond(kFastest)},
                                     {LEAF(Msg, angular.y), beyond(kFastest)},
                                     {LEAF(Msg, angular.z), beyond(kFastest)}});
}

TEST(MsgConversion, C3_EveryNumberOfATransformIsChecked) {
  using Msg = geometry_msgs::Transform;
  Msg sound;
  sound.rotation = heading(0.5);
  EXPECT_NEAR(from_msg(sound)->yaw, 0.5, 1e-12);
  expect_each_checked<Msg>(sound, {{LEAF(Msg, translation.x), beyond(kFarthest)},
                                   {LEAF(Msg, translation.y), beyond(kFarthest)},
                                   {LEAF(Msg, translation.z), beyond(kFarthest)},
                                   {LEAF(Msg, rotation.x), {0.2}},
                                   {LEAF(Msg, rotation.y), {0.2}},
                                   {LEAF(Msg, rotation.z), {0.0}},
                                   {LEAF(Msg, rotation.w), {0.0, 1.0}}});
  EXPECT_FALSE(from_msg(Msg()).has_value()) << "no rotation";
}

TEST(MsgConversion, C3_EveryNumberOfAnOdometryIsChecked) {
  using Msg = nav_msgs::Odometry;
  expect_each_checked<Msg>(odometry(), {{LEAF(Msg, pose.pose.position.x), beyond(kFarthest)},
                                        {LEAF(Msg, pose.pose.position.y), beyond(kFarthest)},
                                        {LEAF(Msg, pose.pose.position.z), beyond(kFarthest)},
                                        {LEAF(Msg, pose.pose.orientation.x), {0.2}},
                                        {LEAF(Msg, pose.pose.orientation.y), {0.2}},
                                        {LEAF(Msg, pose.pose.orientation.z), {0.0}},
                                        {LEAF(Msg, pose.pose.orientation.w), {0.0}},
                                        {LEAF(Msg, twist.twist.linear.x), beyond(kFastest)},
                                        {LEAF(Msg, twist.twist.linear.y), beyond(kFastest)},
                                        {LEAF(Msg, twist.twist.linear.z), beyond(kFastest)},
                                        {LEAF(Msg, twist.twist.angular.x), beyond(kFastest)},
                                        {LEAF(Msg, twist.twist.angular.y), beyond(kFastest)},
                                        {LEAF(Msg, twist.twist.angular.z), beyond(kFastest)}});
}

TEST(MsgConversion, C3_EveryNumberOfAProximityIsChecked) {
  using Msg = navvi_msgs::Proximity;
  expect_each_checked<Msg>(proximity(),
                           {{LEAF(Msg, detection_radius), {-1.0, 0.0, 1.001 * kLongest}},
                            {LEAF(Msg, things[0].gap), beyond(kLongest)},
                            {LEAF(Msg, things[0].nearest.x), beyond(kFarthest)},
                            {LEAF(Msg, things[0].nearest.y), beyond(kFarthest)},
                            {LEAF(Msg, things[0].nearest.z), beyond(kFarthest)}});
  Msg crowd = proximity();
  crowd.things.resize(kMostThings + 1, crowd.things[0]);
  EXPECT_FALSE(from_msg(crowd).has_value());
}

TEST(MsgConversion, C3_EveryNumberOfAContactIsChecked) {
  using Msg = navvi_msgs::Contact;
  expect_each_checked<Msg>(contact(), {{LEAF(Msg, point.x), beyond(kFarthest)},
                                       {LEAF(Msg, point.y), beyond(kFarthest)},
                                       {LEAF(Msg, point.z), beyond(kFarthest)},
                                       {LEAF(Msg, robot.position.x), beyond(kFarthest)},
                                       {LEAF(Msg, robot.position.y), beyond(kFarthest)},
                                       {LEAF(Msg, robot.position.z), beyond(kFarthest)},
                                       {LEAF(Msg, robot.orientation.x), {0.2}},
                                       {LEAF(Msg, robot.orientation.y), {0.2}},
                                       {LEAF(Msg, robot.orientation.z), {0.0}},
                                       {LEAF(Msg, robot.orientation.w), {0.0}},
                                       {LEAF(Msg, speed), beyond(kFastest)}});
  Msg none = contact();
  none.seq = 0;
  EXPECT_FALSE(from_msg(none).has_value()) << "the first is 1";
}

TEST(MsgConversion, C3_EveryNumberOfAnObstacleIsChecked) {
  using Msg = navvi_msgs::Obstacles;
  expect_each_checked<Msg>(obstacles(),
                           {{LEAF(Msg, obstacles[0].pose.position.x), beyond(kFarthest)},
                            {LEAF(Msg, obstacles[0].pose.position.y), beyond(kFarthest)},
                            {LEAF(Msg, obstacles[0].pose.position.z), beyond(kFarthest)},
                            {LEAF(Msg, obstacles[0].pose.orientation.x), {0.2}},
                            {LEAF(Msg, obstacles[0].pose.orientation.y), {0.2}},
                            {LEAF(Msg, obstacles[0].pose.orientation.z), {0.0}},
                            {LEAF(Msg, obstacles[0].pose.orientation.w), {0.0}},
                            {LEAF(Msg, obstacles[0].velocity.x), beyond(kFastest)},
                            {LEAF(Msg, obstacles[0].velocity.y), beyond(kFastest)},
                            {LEAF(Msg, obstacles[0].velocity.z), beyond(kFastest)},
                            {LEAF(Msg, obstacles[0].radius), {-1.0, 0.0, 1.001 * kLargest}},
                            {LEAF(Msg, obstacles[0].height), {-1.0, 0.0, 1.001 * kLargest}},
                            {LEAF(Msg, obstacles[0].length), {-1.0, 0.0, 3.0}},
                            {LEAF(Msg, obstacles[0].width), {-1.0, 0.0, 3.0}}});
  Msg twins = obstacles();
  twins.obstacles.push_back(twins.obstacles[0]);
  EXPECT_FALSE(from_msg(twins).has_value());
}

TEST(MsgConversion, C3_EveryNumberOfAGuidanceIsChecked) {
  using Msg = navvi_msgs::Guidance;
  const auto length = beyond_from_0(kLongest), duration = beyond_from_0(kLongestTime);
  const std::vector<double> or_none = {-0.5, -2.0, 1.001 * kLongestTime};
  expect_each_checked<Msg>(guidance(), {{LEAF(Msg, plan_time), duration},
                                        {LEAF(Msg, mesh_age), or_none},
                                        {LEAF(Msg, map_age), or_none},
                                        {LEAF(Msg, blocked_distance), length},
                                        {LEAF(Msg, blocked_for), or_none},
                                        {LEAF(Msg, goal.x), beyond(kFarthest)},
                                        {LEAF(Msg, goal.y), beyond(kFarthest)},
                                        {LEAF(Msg, goal.z), beyond(kFarthest)},
                                        {LEAF(Msg, waypoint.x), beyond(kFarthest)},
                                        {LEAF(Msg, waypoint.y), beyond(kFarthest)},
                                        {LEAF(Msg, waypoint.z), beyond(kFarthest)},
                                        {LEAF(Msg, waypoint_distance), length},
                                        {LEAF(Msg, waypoint_angle), beyond(M_PI)},
                                        {LEAF(Msg, steer_angle), beyond(M_PI)},
                                        {LEAF(Msg, turn_angle), beyond(M_PI)},
                                        {LEAF(Msg, goal_distance), length},
                                        {LEAF(Msg, eta), duration},
                                        {LEAF(Msg, shortest_length), length},
                                        {LEAF(Msg, path_offset), length}});
}

TEST(MsgConversion, C3_EveryNumberOfAScenarioIsChecked) {
  using Msg = navvi_msgs::Scenario;
  expect_each_checked<Msg>(scenario(), {{LEAF(Msg, goal.x), beyond(kFarthest)},
                                        {LEAF(Msg, places[0].at.x), beyond(kFarthest)},
                                        {LEAF(Msg, places[0].low.y), beyond(kFarthest)},
                                        {LEAF(Msg, places[0].high.x), beyond(kFarthest)},
                                        {LEAF(Msg, goal.y), beyond(kFarthest)},
                                        {LEAF(Msg, goal.z), beyond(kFarthest)},
                                        {LEAF(Msg, start.position.x), beyond(kFarthest)},
                                        {LEAF(Msg, start.position.y), beyond(kFarthest)},
                                        {LEAF(Msg, start.position.z), beyond(kFarthest)},
                                        {LEAF(Msg, start.orientation.x), {0.2}},
                                        {LEAF(Msg, start.orientation.y), {0.2}},
                                        {LEAF(Msg, start.orientation.z), {0.0}},
                                        {LEAF(Msg, start.orientation.w), {0.0}}});
}

TEST(MsgConversion, AGoalNeedsAPlaceButNoDirection) {
  using Msg = geometry_msgs::PoseStamped;
  EXPECT_TRUE(from_msg(Msg()).has_value());
  EXPECT_EQ(from_msg(goal_msg({1.0, 2.0}, kStamp)), Eigen::Vector2d(1.0, 2.0));
  expect_each_checked<Msg>(Msg(), {{LEAF(Msg, pose.position.x), beyond(kFarthest)},
                                   {LEAF(Msg, pose.position.y), beyond(kFarthest)},
                                   {LEAF(Msg, pose.position.z), beyond(kFarthest)}});
  for (double* (*leaf)(Msg&) : {+[](Msg& m) { return &m.pose.orientation.x; },
                                +[](Msg& m) { return &m.pose.orientation.w; }}) {
    Msg msg;
    *leaf(msg) = NAN;
    EXPECT_FALSE(from_msg(msg).has_value());
  }
}

TEST(MsgConversion, AClickedPointIsAPlace) {
  using Msg = geometry_msgs::PointStamped;
  Msg msg;
  msg.point.x = 1.0;
  msg.point.y = 2.0;
  EXPECT_EQ(from_msg(msg), Eigen::Vector2d(1.0, 2.0));
  expect_each_checked<Msg>(msg, {{LEAF(Msg, point.x), beyond(kFarthest)},
                                 {LEAF(Msg, point.y), beyond(kFarthest)},
                                 {LEAF(Msg, point.z), beyond(kFarthest)}});
}

TEST(MsgConversion, APathLooksAlongItselfAndWithABadPointIsDropped) {
  using Msg = nav_msgs::Path;
  const std::vector<Eigen::Vector2d> points = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}};
  const Msg path = path_msg(points, 0.1, kStamp);
  EXPECT_EQ(from_msg(path), points);
  EXPECT_EQ(path.header.frame_id, "map");
  EXPECT_EQ(path.poses[0].pose.orientation.w, 1.0);
  EXPECT_NEAR(path.poses[2].pose.orientation.z, std::sqrt(0.5), 1e-12);
  expect_each_checked<Msg>(path, {{LEAF(Msg, poses[1].pose.position.x), beyond(kFarthest)},
                                  {LEAF(Msg, poses[1].pose.position.y), beyond(kFarthest)},
                                  {LEAF(Msg, poses[1].pose.position.z), beyond(kFarthest)}});
  Msg endless;
  endless.poses.resize(kMostPoints + 1);
  EXPECT_FALSE(from_msg(endless).has_value());
}

TEST(MsgConversion, AMotorOfACueIsBetweenStillAndFull) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), -0.01F, 1.01F}) {
    navvi_msgs::Cue left = cue(), right = cue();
    left.left = right.right = bad;
    EXPECT_FALSE(from_msg(left).has_value()) << bad;
    EXPECT_FALSE(from_msg(right).has_value()) << bad;
  }
}

TEST(MsgConversion, APatternOrASoundThatIsNoneDropsItsMessage) {
  navvi_msgs::Cue msg = cue();
  for (const std::uint8_t modality : {navvi_msgs::Cue::RUMBLE, navvi_msgs::Cue::SOUND}) {
    msg.modality = modality;
    msg.kind = "whistle";
    EXPECT_FALSE(from_msg(msg).has_value());
  }
  msg.modality = navvi_msgs::Cue::SPEECH;
  msg.kind = "tutorial_stop";
  ASSERT_TRUE(from_msg(msg).has_value());
  EXPECT_EQ(from_msg(msg)->kind(), CueKind::lesson);
  EXPECT_EQ(from_msg(msg)->word(), "tutorial_stop") << "the key of a lesson's text";
}

TEST(MsgConversion, AConstantThatIsNoneDropsItsMessage) {
  using G = navvi_msgs::Guidance;
  using C = navvi_msgs::Cue;
  using D = navvi_msgs::DriveState;
  const auto expect_dropped = [](auto msg, auto member, auto value) {
    msg.*member = static_cast<std::uint8_t>(names(value).size() - 1);
    EXPECT_TRUE(from_msg(msg).has_value());
    ++(msg.*member);
    EXPECT_FALSE(from_msg(msg).has_value());
  };
  expect_dropped(guidance(), &G::state, Guidance::State{});
  expect_dropped(guidance(), &G::refusal, Guidance::Refusal{});
  expect_dropped(guidance(), &G::replan_reason, Guidance::Replan{});
  expect_dropped(guidance(), &G::reroute_reason, Guidance::Replan{});
  expect_dropped(cue(), &C::stage, CueStage{});
  navvi_msgs::Cue sound = cue();
  sound.kind = "turn";  // a word of the last modality
  expect_dropped(sound, &C::modality, Modality{});
  expect_dropped(cue(), &C::priority, Priority{});
  expect_dropped(drive_state(), &D::state, DriveState::State{});
  expect_dropped(drive_state(), &D::reason, DriveState::Reason{});
  expect_dropped(drive_state(), &D::assistance, DriveState::Assistance{});
  expect_dropped(link_state(), &navvi_msgs::LinkState::late, LinkState::Late{});
  expect_dropped(navvi_msgs::TrialState(), &navvi_msgs::TrialState::state, TrialState::State{});
  expect_dropped(navvi_msgs::TrialRequest(), &navvi_msgs::TrialRequest::request,
                 TrialRequest::Kind{});
}

/// The words of the constants that stand before `field` in the definition of a message.
template <typename Msg>
std::vector<std::string> constants_of(const std::string& field) {
  static const std::regex kConstant("uint8 ([A-Z_]+)=([0-9]+).*");
  std::istringstream definition(ros::message_traits::Definition<Msg>::value());
  std::vector<std::string> words;
  for (std::string line; std::getline(definition, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kConstant)) {
      EXPECT_EQ(std::stoul(match[2]), words.size()) << line;
      words.push_back(match[1]);
      for (char& letter : words.back()) letter = static_cast<char>(std::tolower(letter));
    } else if (line.rfind("uint8 ", 0) == 0) {
      if (line.substr(6, line.find(' ', 6) - 6) == field) return words;
      words.clear();
    }
  }
  ADD_FAILURE() << "there is no " << field;
  return {};
}

TEST(MsgConversion, EachEnumerationHasTheConstantsOfItsMessage) {
  const auto words = [](auto none) {
    const auto all = names(none);
    return std::vector<std::string>(all.begin(), all.end());
  };
  EXPECT_EQ(words(Guidance::State{}), constants_of<navvi_msgs::Guidance>("state"));
  EXPECT_EQ(words(Guidance::Replan{}), constants_of<navvi_msgs::Guidance>("replan_reason"));
  std::vector<std::string> refusals = constants_of<navvi_msgs::Guidance>("refusal");
  EXPECT_EQ(std::exchange(refusals.at(0), "none"), "not_refused");
  EXPECT_EQ(words(Guidance::Refusal{}), refusals);
  EXPECT_EQ(words(CueStage{}), constants_of<navvi_msgs::Cue>("stage"));
  EXPECT_EQ(words(Modality{}), constants_of<navvi_msgs::Cue>("modality"));
  EXPECT_EQ(words(Priority{}), constants_of<navvi_msgs::Cue>("priority"));
  EXPECT_EQ(words(DriveState::State{}), constants_of<navvi_msgs::DriveState>("state"));
  EXPECT_EQ(words(DriveState::Reason{}), constants_of<navvi_msgs::DriveState>("reason"));
  EXPECT_EQ(words(DriveState::Assistance{}), constants_of<navvi_msgs::DriveState>("assistance"));
  EXPECT_EQ(words(LinkState::Late{}), constants_of<navvi_msgs::LinkState>("late"));
}

TEST(MsgConversion, AnUnknownClassIsOtherAndSoIsTheFloor) {
  for (const char* word : {"dragon", "", "floor"}) {
    navvi_msgs::Proximity msg = proximity();
    msg.things[0].thing_class = word;
    EXPECT_EQ(from_msg(msg)->things[0].thing_class, ThingClass::other) << word;
  }
  navvi_msgs::Contact msg = contact();
  msg.counts[0].thing_class = "dragon";
  msg.counts[1].thing_class = "other";
  EXPECT_EQ(from_msg(msg)->counts.at(ThingClass::other), 4U);
}

TEST(MsgConversion, AHashIsSixteenHexadecimalDigits) {
  EXPECT_EQ(from_msg(state_hash())->hash, 0x00f3456789abcdefU);
  for (const char* bad : {"", "0123456789abcde", "0123456789abcdef0", "0123456789abcdeg",
                          "-123456789abcdef", "0123456789ABCDEF"}) {
    navvi_msgs::StateHash msg = state_hash();
    msg.hash = bad;
    EXPECT_FALSE(from_msg(msg).has_value()) << bad;
  }
}

}  // namespace
}  // namespace navvi_types
