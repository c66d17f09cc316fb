#include "navvi_nav/node/msg_conversion.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace navvi_nav::node {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

geometry_msgs::Transform transform_at(double x, double y, double yaw) {
  geometry_msgs::Transform out;
  out.translation.x = x;
  out.translation.y = y;
  out.rotation.z = std::sin(yaw / 2);
  out.rotation.w = std::cos(yaw / 2);
  return out;
}

navvi_msgs::Obstacle sound_obstacle() {
  navvi_msgs::Obstacle out;
  out.id = 3;
  out.pose.position.x = 1.0;
  out.pose.orientation.w = 1.0;
  out.radius = 0.5;
  out.height = 1.8;
  return out;
}

TEST(MsgConversion, takes_a_sound_pose_and_drops_a_broken_one) {
  const auto pose = from_msg(transform_at(1, 2, 0.7));
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->yaw, 0.7, 1e-12);
  EXPECT_FALSE(from_msg(transform_at(kNan, 2, 0)));
  EXPECT_FALSE(from_msg(transform_at(1e300, 2, 0)));
  EXPECT_FALSE(from_msg(transform_at(1, 2, kNan)));
  EXPECT_FALSE(from_msg(geometry_msgs::Transform()));  // a rotation of no length
}

TEST(MsgConversion, drops_all_obstacles_if_one_is_bad) {
  navvi_msgs::Obstacles msg;
  EXPECT_TRUE(from_msg(msg));
  msg.obstacles = {sound_obstacle()};
  ASSERT_TRUE(from_msg(msg));
  EXPECT_DOUBLE_EQ(from_msg(msg)->front().cylinder.radius, 0.5);
  for (const double bad : {0.0, -1.0, 1e9, kNan}) {
    msg.obstacles = {sound_obstacle()};
    msg.obstacles[0].radius = bad;
    EXPECT_FALSE(from_msg(msg)) << bad;
  }
  msg.obstacles = {sound_obstacle(), sound_obstacle()};  // one id twice
  EXPECT_FALSE(from_msg(msg));
}

TEST(MsgConversion, takes_the_rectangle_of_an_obstacle_along_its_heading_or_drops_all) {
  navvi_msgs::Obstacles msg;
  msg.obstacles = {sound_obstacle()};
  navvi_msgs::Obstacle& obstacle = msg.obstacles[0];
  obstacle.length = 0.8;
  obstacle.width = 0.4;
  obstacle.pose.orientation.z = std::sin(0.6);
  obstacle.pose.orientation.w = std::cos(0.6);
  const auto things = from_msg(msg);
  ASSERT_TRUE(things);
  EXPECT_NEAR(things->front().yaw, 1.2, 1e-12);
  EXPECT_EQ(things->front().length, 0.8);
  EXPECT_EQ(things->front().width, 0.4);
  for (const double bad : {0.0, -0.4, 2.0, kNan}) {
    obstacle.width = bad;
    EXPECT_FALSE(from_msg(msg)) << bad;
  }
}

TEST(MsgConversion, drops_a_goal_with_any_number_that_is_not_finite) {
  geometry_msgs::PoseStamped goal;
  goal.pose.position.x = 3.0;
  EXPECT_TRUE(from_msg(goal));
  goal.pose.orientation.z = kNan;
  EXPECT_FALSE(from_msg(goal));
  goal.pose.orientation.z = 0.0;
  goal.pose.position.z = kNan;
  EXPECT_FALSE(from_msg(goal));
}

TEST(MsgConversion, reads_an_occupancy_grid_that_lies_flat) {
  nav_msgs::OccupancyGrid msg;
  msg.header.frame_id = "map";
  EXPECT_FALSE(from_msg(msg, "map"));  // a rotation of no length
  msg.info.origin.orientation.w = 1.0;
  EXPECT_TRUE(from_msg(msg, "map"));
  EXPECT_FALSE(from_msg(msg, "odom"));
  msg.info.width = 2;
  msg.info.height = 1;
  msg.info.resolution = 0.05F;
  msg.info.origin.position.x = -3.0;
  msg.data = {-1, 100};
  ASSERT_TRUE(from_msg(msg, "map"));
  EXPECT_EQ(from_msg(msg, "map")->width, 2);
  EXPECT_DOUBLE_EQ(from_msg(msg, "map")->origin.x, -3.0);
  EXPECT_EQ(from_msg(msg, "map")->cells, (std::vector<std::int8_t>{-1, 100}));
  msg.info.origin.orientation.z = std::sin(0.5);
  msg.info.origin.orientation.w = std::cos(0.5);
  EXPECT_NEAR(from_msg(msg, "map")->yaw, 1.0, 1e-9);
  msg.info.origin.orientation.x = 0.2;
  EXPECT_FALSE(from_msg(msg, "map"));
  msg.info.origin.orientation.x = 0.0;
  msg.info.origin.position.y = kNan;
  EXPECT_FALSE(from_msg(msg, "map"));
  msg.info.origin.position.y = 0.0;
  msg.info.width = 4000000000U;
  EXPECT_FALSE(from_msg(msg, "map"));
}

TEST(MsgConversion, says_why_a_map_cannot_be_used) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = "map";
  EXPECT_EQ(error_of(msg, "map"), "");
  EXPECT_EQ(error_of(msg, "world"), "it is in frame 'map', not 'world'");
  msg.data.resize(map::kMaxMapBytes + 1);
  EXPECT_EQ(error_of(msg, "map"), "it is larger than 64 MiB");
}

TEST(MsgConversion, writes_an_empty_path_as_an_empty_message) {
  EXPECT_TRUE(to_msg(Path{}, 0.0, "map", ros::Time(1)).poses.empty());
  EXPECT_EQ(to_msg(Path{{1, 1}}, 0.0, "map", ros::Time(1)).poses.size(), 1U);
}

TEST(MsgConversion, agrees_with_the_message_on_every_state_refusal_and_reason) {
  using navvi_msgs::Guidance;
  guide::Status status;
  status.state = plan::State::pose_stale;
  status.refusal = plan::Refusal::unreachable;
  status.reason = plan::Reason::map_changed;
  const Guidance msg = to_msg(status, 0.0, "map", ros::Time(1));
  EXPECT_EQ(msg.state, Guidance::POSE_STALE);
  EXPECT_EQ(msg.refusal, Guidance::UNREACHABLE);
  EXPECT_EQ(msg.replan_reason, Guidance::MAP_CHANGED);
  EXPECT_EQ(msg.mesh_age, -1.0);
  EXPECT_EQ(msg.map_age, -1.0);
  EXPECT_EQ(msg.blocked_for, 0.0);
  EXPECT_EQ(static_cast<int>(plan::State::off_mesh), Guidance::OFF_MESH);
  EXPECT_EQ(static_cast<int>(plan::State::map_stale), Guidance::MAP_STALE);
  EXPECT_EQ(static_cast<int>(plan::State::blocked), Guidance::BLOCKED);
  EXPECT_EQ(static_cast<int>(plan::State::make_room), Guidance::MAKE_ROOM);
  EXPECT_EQ(static_cast<int>(plan::Refusal::inside_obstacle), Guidance::INSIDE_OBSTACLE);
  EXPECT_EQ(static_cast<int>(plan::Reason::waypoint_blocked), Guidance::WAYPOINT_BLOCKED);
}

}  // namespace
}  // namespace navvi_nav::node

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
