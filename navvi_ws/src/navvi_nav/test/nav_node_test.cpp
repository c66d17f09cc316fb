// nav_node from outside: a map, a robot and obstacles are played to it.

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Obstacles.h>
#include <octomap_msgs/Octomap.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <functional>
#include <limits>
#include <sstream>

#include "small_world.hpp"

namespace navvi_nav {
namespace {

constexpr double kPatience = 15.0;  // s

class NavNodeTest : public testing::Test {
 protected:
  NavNodeTest() {
    map_ = node_.advertise<octomap_msgs::Octomap>("octomap_binary", 1, true);
    obstacles_ = node_.advertise<navvi_msgs::Obstacles>("navvi/obstacles", 1);
    odometry_ = node_.advertise<nav_msgs::Odometry>("odom", 1);
    goal_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
    subscribers_ = {
        node_.subscribe<navvi_msgs::Guidance>(
            "navvi/guidance", 50,
            [this](const navvi_msgs::Guidance::ConstPtr& msg) { guidance_ = *msg; }),
        node_.subscribe<nav_msgs::Path>(
            "navvi/path", 10, [this](const nav_msgs::Path::ConstPtr& msg) { path_ = *msg; }),
        node_.subscribe<visualization_msgs::MarkerArray>(
            "navvi/navmesh", 1,
            [this](const visualization_msgs::MarkerArray::ConstPtr& msg) { mesh_ = *msg; })};
    heartbeat_ = node_.createWallTimer(ros::WallDuration(0.05),
                                       [this](const ros::WallTimerEvent&) { play_robot(); });
    EXPECT_TRUE(until([this] { return goal_.getNumSubscribers() > 0; }));
  }

  void play_robot() {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = "map";
    transform.child_frame_id = "base_link";
    transform.transform.translation.x = 2.0;
    transform.transform.translation.y = 5.0;
    transform.transform.rotation.w = 1.0;
    broadcaster_.sendTransform(transform);
    nav_msgs::Odometry odometry;
    odometry.header = transform.header;
    odometry.twist.twist.linear.x = 0.5;
    odometry_.publish(odometry);
    obstacles_.publish(played_);
  }

  void send_map() {
    SmallWorld world;
    world.room(16, 10).box(6, 3, 0, 9, 7, 1.0);
    octomap::OcTree tree = world.tree();
    std::ostringstream out;
    tree.writeBinaryData(out);
    const std::string text = out.str();
    octomap_msgs::Octomap msg;
    msg.header.frame_id = "map";
    msg.binary = 1;
    msg.id = "OcTree";
    msg.resolution = tree.getResolution();
    msg.data.assign(text.begin(), text.end());
    map_.publish(msg);
  }

  void send_goal(double x, double y, const std::string& frame = "map") {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = frame;
    goal.pose.position.x = x;
    goal.pose.position.y = y;
    goal.pose.orientation.w = 1.0;
    goal_.publish(goal);
  }

  static bool until(const std::function<bool()>& done) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
    while (!done() && ros::WallTime::now() < end && ros::ok())
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    return done();
  }
  [[nodiscard]] bool refused_as(int refusal) const {
    return guidance_.state == navvi_msgs::Guidance::GOAL_REFUSED && guidance_.refusal == refusal;
  }

  ros::NodeHandle node_;
  ros::Publisher map_, obstacles_, odometry_, goal_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer heartbeat_;
  tf2_ros::TransformBroadcaster broadcaster_;
  navvi_msgs::Obstacles played_;
  navvi_msgs::Guidance guidance_;
  nav_msgs::Path path_;
  visualization_msgs::MarkerArray mesh_;
};

TEST_F(NavNodeTest, guides_refuses_and_replans) {
  played_.header.frame_id = "map";
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::NO_MAP; }));
  send_map();
  ASSERT_TRUE(until([this] { return !mesh_.markers.empty(); }));
  ASSERT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::NO_GOAL; }));

  send_goal(14, 5);
  ASSERT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; }));
  EXPECT_EQ(guidance_.replan_reason, navvi_msgs::Guidance::NEW_GOAL);
  ASSERT_TRUE(until([this] { return path_.poses.size() >= 3; }));
  EXPECT_EQ(path_.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(path_.poses.back().pose.position.x, 14.0);
  EXPECT_GT(guidance_.goal_distance, 12.0);

  // An obstacle between the first two corners after the robot.
  const auto& a = path_.poses[1].pose.position;
  const auto& b = path_.poses[2].pose.position;
  navvi_msgs::Obstacle obstacle;
  obstacle.id = 1;
  obstacle.thing_class = "forklift";
  obstacle.pose.position.x = 0.5 * (a.x + b.x);
  obstacle.pose.position.y = 0.5 * (a.y + b.y);
  obstacle.pose.orientation.w = 1.0;
  obstacle.radius = 0.5;
  obstacle.height = 2.0;
  played_.obstacles = {obstacle};
  EXPECT_TRUE(until([this] {
    return guidance_.replan_reason == navvi_msgs::Guidance::PATH_CARVED ||
           guidance_.replan_reason == navvi_msgs::Guidance::WAYPOINT_BLOCKED;
  }));
  EXPECT_EQ(guidance_.state, navvi_msgs::Guidance::FOLLOWING);

  // What cannot be read does not take the goal away; what can be read is a new request.
  send_goal(std::numeric_limits<double>::quiet_NaN(), 5);
  send_goal(14, 5, "nowhere");
  const unsigned before = guidance_.seq;
  EXPECT_TRUE(until([&] { return guidance_.seq > before + 5; }));
  EXPECT_EQ(guidance_.state, navvi_msgs::Guidance::FOLLOWING);
  EXPECT_FALSE(path_.poses.empty());
  send_goal(7, 5);
  EXPECT_TRUE(until([this] { return refused_as(navvi_msgs::Guidance::INSIDE_OBSTACLE); }));
  EXPECT_TRUE(until([this] { return path_.poses.empty(); }));
  send_goal(40, 5);
  EXPECT_TRUE(until([this] { return refused_as(navvi_msgs::Guidance::OFF_THE_MAP); }));
  send_goal(std::numeric_limits<double>::quiet_NaN(), 5);
  EXPECT_TRUE(until([this] { return refused_as(navvi_msgs::Guidance::NOT_FINITE); }));
  send_goal(14, 5, "nowhere");
  EXPECT_TRUE(until([this] { return refused_as(navvi_msgs::Guidance::UNKNOWN_FRAME); }));

  send_goal(2.5, 5.2);
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::ARRIVED; }));
}

TEST_F(NavNodeTest, lives_on_after_garbage) {
  octomap_msgs::Octomap map;
  map.header.frame_id = "map";
  map.binary = 1;
  map.id = "OcTree";
  map.resolution = 0.05;
  map.data.assign(100000, -1);
  map_.publish(map);
  map.resolution = std::numeric_limits<double>::quiet_NaN();
  map_.publish(map);
  navvi_msgs::Obstacle obstacle;
  obstacle.radius = std::numeric_limits<double>::infinity();
  played_.header.frame_id = "map";
  played_.obstacles = {obstacle};
  const unsigned before = guidance_.seq;
  EXPECT_TRUE(until([&] { return guidance_.seq > before + 10; }));
  played_.obstacles.clear();
  send_map();
  send_goal(14, 5);
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; }));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "nav_node_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
