#include "navvi_feedback/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace navvi_feedback {
namespace {

const std::vector<double> kBad = {std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity(), 1e308};

navvi_msgs::Proximity proximity() {
  navvi_msgs::Proximity msg;
  msg.detection_radius = 5.0;
  navvi_msgs::ProximityThing thing;
  thing.id = 7;
  thing.thing_class = "pallet_robot";
  thing.moving = true;
  thing.gap = 1.25;
  thing.nearest.x = 1.0;
  thing.nearest.y = -0.5;
  msg.things.push_back(thing);
  return msg;
}

navvi_msgs::Contact contact() {
  navvi_msgs::Contact msg;
  msg.thing_class = "shelf";
  msg.robot.position.x = 2.0;
  msg.robot.position.y = 3.0;
  msg.robot.orientation.w = msg.robot.orientation.z = std::sqrt(0.5);  // looks along +y
  msg.point.x = 1.65;
  msg.point.y = 3.0;
  return msg;
}

navvi_msgs::Guidance guidance() {
  navvi_msgs::Guidance msg;
  msg.seq = 9;
  msg.state = navvi_msgs::Guidance::FOLLOWING;
  msg.replan_reason = navvi_msgs::Guidance::PERIOD;
  msg.goal.x = 6.0;
  msg.waypoint.y = 2.0;
  msg.waypoint_distance = 2.0;
  msg.waypoint_angle = msg.steer_angle = -1.5;
  msg.turn_angle = 1.0;
  msg.goal_distance = 8.0;
  msg.path_offset = 0.1;
  return msg;
}

nav_msgs::Odometry odometry() {
  nav_msgs::Odometry msg;
  msg.pose.pose.orientation.w = 1.0;
  msg.twist.twist.linear.x = 0.5;
  msg.twist.twist.angular.z = -0.25;
  return msg;
}

/// Every bad number at every place makes the message nothing.
template <typename Msg>
void expect_refused(const std::function<Msg()>& good,
                    const std::vector<std::function<double&(Msg&)>>& places) {
  ASSERT_TRUE(from_msg(good()).has_value());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const double bad : kBad) {
      Msg msg = good();
      places[i](msg) = bad;
      EXPECT_FALSE(from_msg(msg).has_value()) << "place " << i << ", value " << bad;
    }
  }
}

TEST(FromMsg, ProximityKeepsWhatItSays) {
  const auto things = from_msg(proximity());
  ASSERT_TRUE(things);
  ASSERT_EQ(things->size(), 1u);
  EXPECT_EQ(things->front().thing_class, ThingClass::pallet_robot);
  EXPECT_EQ(things->front().id, 7u);
  EXPECT_EQ(things->front().gap, 1.25);
  EXPECT_EQ(things->front().nearest, Eigen::Vector2d(1.0, -0.5));
  EXPECT_TRUE(things->front().moving);
}

TEST(FromMsg, AnEmptyProximityIsNothingNear) {
  navvi_msgs::Proximity msg = proximity();
  msg.things.clear();
  ASSERT_TRUE(from_msg(msg));
  EXPECT_TRUE(from_msg(msg)->empty());
  EXPECT_FALSE(from_msg(navvi_msgs::Proximity()).has_value()) << "no radius";
}

TEST(FromMsg, AnUnknownClassIsOther) {
  navvi_msgs::Proximity msg = proximity();
  msg.things[0].thing_class = "dragon";
  EXPECT_EQ(from_msg(msg)->front().thing_class, ThingClass::other);
}

TEST(FromMsg, BadNumbersMakeAMessageNothing) {
  using navvi_msgs::Contact;
  using navvi_msgs::Proximity;
  expect_refused<Proximity>(proximity,
                            {[](Proximity& m) -> double& { return m.detection_radius; },
                             [](Proximity& m) -> double& { return m.things[0].gap; },
                             [](Proximity& m) -> double& { return m.things[0].nearest.x; },
                             [](Proximity& m) -> double& { return m.things[0].nearest.y; },
                             [](Proximity& m) -> double& { return m.things[0].nearest.z; }});
  expect_refused<Contact>(contact, {[](Contact& m) -> double& { return m.point.x; },
                                    [](Contact& m) -> double& { return m.point.z; },
                                    [](Contact& m) -> double& { return m.robot.position.y; },
                                    [](Contact& m) -> double& { return m.robot.orientation.w; },
                                    [](Contact& m) -> double& { return m.speed; }});
  expect_refused<nav_msgs::Odometry>(
      odometry, {[](nav_msgs::Odometry& m) -> double& { return m.twist.twist.linear.x; },
                 [](nav_msgs::Odometry& m) -> double& { return m.twist.twist.angular.z; },
                 [](nav_msgs::Odometry& m) -> double& { return m.pose.pose.position.x; },
                 [](nav_msgs::Odometry& m) -> double& { return m.pose.pose.orientation.z; }});
}

TEST(FromMsg, BadNumbersMakeGuidanceNothing) {
  using Msg = navvi_msgs::Guidance;
  expect_refused<Msg>(guidance, {[](Msg& m) -> double& { return m.goal.x; },
                                 [](Msg& m) -> double& { return m.waypoint.y; },
                                 [](Msg& m) -> double& { return m.waypoint_distance; },
                                 [](Msg& m) -> double& { return m.waypoint_angle; },
                                 [](Msg& m) -> double& { return m.turn_angle; },
                                 [](Msg& m) -> double& { return m.goal_distance; },
                                 [](Msg& m) -> double& { return m.path_offset; }});
  Msg unknown = guidance();
  unknown.state = 99;
  EXPECT_FALSE(from_msg(unknown).has_value());
  Msg beyond = guidance();
  beyond.waypoint_angle = beyond.steer_angle = 4.0;
  EXPECT_FALSE(from_msg(beyond).has_value());
  Msg negative = guidance();
  negative.goal_distance = -1.0;
  EXPECT_FALSE(from_msg(negative).has_value());
}

TEST(FromMsg, GuidanceKeepsWhatItSays) {
  const Guidance result = *from_msg(guidance());
  EXPECT_EQ(result.seq, 9u);
  EXPECT_EQ(result.state, Guidance::State::following);
  EXPECT_EQ(result.replan_reason, Guidance::Replan::period);
  EXPECT_EQ(result.goal, Eigen::Vector2d(6.0, 0.0));
  EXPECT_EQ(result.waypoint_angle, -1.5);
}

TEST(FromMsg, AContactIsSeenFromTheRobot) {
  const auto result = from_msg(contact());
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->point.x(), 0.0, 1e-9);
  EXPECT_NEAR(result->point.y(), 0.35, 1e-9);  // it looks along +y, so -x is its left
  EXPECT_EQ(result->thing_class, ThingClass::shelf);
}

TEST(FromMsg, APathWithABadPointIsNothing) {
  nav_msgs::Path path;
  EXPECT_TRUE(from_msg(path)->empty());
  path.poses.resize(3);
  EXPECT_EQ(from_msg(path)->size(), 3u);
  path.poses[1].pose.position.y = kBad[0];
  EXPECT_FALSE(from_msg(path).has_value());
}

TEST(FromMsg, AJoyNeedsTwoAxesInRange) {
  sensor_msgs::Joy msg;
  EXPECT_FALSE(from_msg(msg).has_value());
  msg.axes = {0.5F, -1.0F};
  EXPECT_TRUE(from_msg(msg).has_value());
  for (const float bad : {std::nanf(""), 1.5F, -2.0F, std::numeric_limits<float>::infinity()}) {
    msg.axes[1] = bad;
    EXPECT_FALSE(from_msg(msg).has_value());
  }
}

TEST(Joy, SurvivesTheRoundTrip) {
  InputState input;
  input.live = true;
  input.axes = {0.5, -0.25, 0.0};
  input.buttons = {true, false, true};
  const auto back = from_msg(to_msg(input, ros::Time(3.0)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->axes, input.axes);
  EXPECT_EQ(back->buttons, input.buttons);
}

TEST(DriveStateMsg, AnUnknownStateIsNothing) {
  navvi_msgs::DriveState msg;
  msg.state = navvi_msgs::DriveState::STOPPED;
  EXPECT_EQ(from_msg(msg), Situation::Gate::stopped);
  msg.state = 77;
  EXPECT_FALSE(from_msg(msg).has_value());
}

TEST(ToMsg, RumbleNamesBothMotorsAlsoWhenTheyAreOff) {
  const auto msg = feedback_msg({0.0, 0.5});
  ASSERT_EQ(msg.array.size(), 2u);
  EXPECT_EQ(msg.array[0].type, sensor_msgs::JoyFeedback::TYPE_RUMBLE);
  EXPECT_EQ(msg.array[0].id, 0);
  EXPECT_EQ(msg.array[0].intensity, 0.0F);
  EXPECT_EQ(msg.array[1].id, 1);
  EXPECT_EQ(msg.array[1].intensity, 0.5F);
}

TEST(ToMsg, ACueKeepsItsStageAndPriority) {
  CueEvent event;
  event.id = 5;
  event.stage = CueStage::cut;
  event.cue = {"stuck", "stuck, shelf ahead", Priority::message, 2.0};
  const navvi_msgs::Cue msg = to_msg(event, ros::Time(1.0));
  EXPECT_EQ(msg.stage, navvi_msgs::Cue::CUT);
  EXPECT_EQ(msg.priority, navvi_msgs::Cue::MESSAGE);
  EXPECT_EQ(msg.modality, navvi_msgs::Cue::SPEECH);
  EXPECT_EQ(msg.text, "stuck, shelf ahead");
}

TEST(AngleTo, IsClockwiseFromTheNose) {
  geometry_msgs::Transform robot;
  robot.rotation.w = 1.0;
  EXPECT_NEAR(*angle_to(robot, {1.0, -1.0}), M_PI / 4.0, 1e-9);
  EXPECT_NEAR(*angle_to(robot, {0.0, 1.0}), -M_PI / 2.0, 1e-9);
  robot.rotation.w = 0.0;
  EXPECT_FALSE(angle_to(robot, {1.0, 0.0}).has_value());
}

}  // namespace
}  // namespace navvi_feedback

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
