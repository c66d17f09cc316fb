// nav_node from outside: a map, a robot and obstacles are played to it.

#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/GetPlan.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Obstacles.h>
#include <navvi_msgs/Zone.h>
#include <octomap_msgs/Octomap.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "measured.hpp"
#include "small_world.hpp"

namespace navvi_nav {
namespace {

constexpr double kPatience = 60.0;  // s
double clock_ahead = 0.0;           // s, of the wall clock

class NavNodeTest : public testing::Test {
 protected:
  NavNodeTest() {
    played_.header.frame_id = "map";
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
    clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    clock_timer_ = node_.createWallTimer(
        ros::WallDuration(0.01), [this](const ros::WallTimerEvent&) {
          rosgraph_msgs::Clock now;
          now.clock.fromSec(ros::WallTime::now().toSec() + clock_ahead);
          clock_.publish(now);
        });
    heartbeat_ = node_.createWallTimer(ros::WallDuration(0.05),
                                       [this](const ros::WallTimerEvent&) { play_robot(); });
    EXPECT_TRUE(until([this] { return goal_.getNumSubscribers() > 0; }));
  }

  void play_robot() {
    const geometry_msgs::TransformStamped transform = robot_at(pose_x_, ros::Time::now());
    if (poses_) broadcaster_.sendTransform(transform);
    nav_msgs::Odometry odometry;
    odometry.header = transform.header;
    odometry.pose.pose.position.x = odometry_x_;
    odometry.pose.pose.position.y = 5.0;
    odometry.pose.pose.orientation.w = 1.0;
    odometry.twist.twist.linear.x = 0.5;
    odometry_.publish(odometry);
    if (moves_) moves_();
    played_.header.stamp = transform.header.stamp - ros::Duration(obstacles_age_.value_or(0.0));
    if (!obstacles_age_) played_.header.stamp = ros::Time();
    obstacles_.publish(played_);
  }

  static geometry_msgs::TransformStamped robot_at(double x, const ros::Time& stamp) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = "map";
    transform.child_frame_id = "base_link";
    transform.transform.translation.x = x;
    transform.transform.translation.y = 5.0;
    transform.transform.rotation.w = 1.0;
    return transform;
  }

  /// \param full  as octomap_server's octomap_full, with a shelf more
  void send_map(bool full = false) {
    SmallWorld world;
    world.room(16, 10).box(6, 3, 0, 9, 7, 1.0);
    if (full) world.box(6, 7, 0, 9, 9.9, 1.0);
    octomap_msgs::Octomap msg;
    msg.header.frame_id = "map";
    msg.binary = full ? 0 : 1;
    msg.id = "OcTree";
    msg.resolution = 0.05;
    msg.data = world.bytes(!full);
    map_.publish(msg);
  }

  /// \param stamp  0: none, as a program's
  void send_goal(double x, double y, const std::string& frame = "map",
                 const ros::Time& stamp = ros::Time()) {
    geometry_msgs::PoseStamped goal;
    goal.header.stamp = stamp;
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
  bool lead() {
    send_map();
    send_goal(14, 5);
    return until([this] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; });
  }
  [[nodiscard]] bool refused_as(int refusal) const {
    return guidance_.state == navvi_msgs::Guidance::GOAL_REFUSED && guidance_.refusal == refusal;
  }

  ros::NodeHandle node_;
  ros::Publisher clock_, map_, obstacles_, odometry_, goal_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer clock_timer_, heartbeat_;
  tf2_ros::TransformBroadcaster broadcaster_;
  navvi_msgs::Obstacles played_;
  std::function<void()> moves_;  ///< brings played_ up to date
  std::optional<double> obstacles_age_ = 0.0;  ///< s; nullopt: they have no stamp
  bool poses_ = true;            ///< the robot tells its place
  double pose_x_ = 2.0;          ///< m, by transforms
  double odometry_x_ = 2.0;      ///< m, by odometry
  navvi_msgs::Guidance guidance_;
  nav_msgs::Path path_;
  visualization_msgs::MarkerArray mesh_;
};

TEST_F(NavNodeTest, N5_guides_refuses_and_replans) {
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

  // Beyond the map only a person's second ask leads on: a newer stamp.
  const ros::Time asked = ros::Time::now();
  for (int times = 0; times < 3; ++times) {
    send_goal(40, 8, "map", asked);
    const unsigned plans = guidance_.plans;
    EXPECT_TRUE(until([&] { return guidance_.plans > plans; }));
    EXPECT_TRUE(refused_as(navvi_msgs::Guidance::OFF_THE_MAP));
  }
  send_goal(40, 8, "map", ros::Time::now());
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; }));
  EXPECT_TRUE(guidance_.ends_short);
  EXPECT_DOUBLE_EQ(guidance_.goal.x, 40.0);

  send_goal(2.5, 5.2);
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::ARRIVED; }));
}

/// As clients of move_base expect it.
class MakePlanTest : public NavNodeTest {
 protected:
  MakePlanTest() {
    send_map();
    EXPECT_TRUE(until([this] { return !mesh_.markers.empty(); }));
    EXPECT_TRUE(until([this] { return guidance_.state != navvi_msgs::Guidance::NO_MAP; }));
    client_ = node_.serviceClient<nav_msgs::GetPlan>("move_base/make_plan");
    EXPECT_TRUE(client_.waitForExistence(ros::Duration(5.0)));
  }
  static geometry_msgs::PoseStamped pose(double x, double y, const std::string& frame = "map") {
    geometry_msgs::PoseStamped out;
    out.header.frame_id = frame;
    out.pose.position.x = x;
    out.pose.position.y = y;
    out.pose.orientation.w = 1.0;
    return out;
  }
  nav_msgs::Path plan(const geometry_msgs::PoseStamped& start,
                      const geometry_msgs::PoseStamped& goal, float tolerance = 0.0F) {
    nav_msgs::GetPlan service;
    service.request.start = start;
    service.request.goal = goal;
    service.request.tolerance = tolerance;
    EXPECT_TRUE(client_.call(service));
    return service.response.plan;
  }
  ros::ServiceClient client_;
};

TEST_F(MakePlanTest, plans_from_the_start_given_or_from_the_robot) {
  const nav_msgs::Path given = plan(pose(2, 2), pose(14, 5));
  ASSERT_GE(given.poses.size(), 2U);
  EXPECT_EQ(given.header.frame_id, "map");
  EXPECT_DOUBLE_EQ(given.poses.front().pose.position.y, 2.0);
  EXPECT_DOUBLE_EQ(given.poses.back().pose.position.x, 14.0);
  const nav_msgs::Path robots = plan(pose(0, 0, ""), pose(14, 5));
  ASSERT_GE(robots.poses.size(), 2U);
  EXPECT_DOUBLE_EQ(robots.poses.front().pose.position.x, 2.0);
  EXPECT_DOUBLE_EQ(robots.poses.front().pose.position.y, 5.0);
}

TEST_F(MakePlanTest, gives_an_empty_plan_where_nothing_leads_and_moves_no_goal) {
  EXPECT_TRUE(plan(pose(2, 2), pose(7, 5)).poses.empty());
  EXPECT_TRUE(plan(pose(2, 2), pose(7, 5), 0.5F).poses.empty());
  EXPECT_TRUE(plan(pose(2, 2), pose(std::numeric_limits<double>::quiet_NaN(), 5)).poses.empty());
  EXPECT_TRUE(plan(pose(2, 2, "nowhere"), pose(14, 5)).poses.empty());
  EXPECT_TRUE(plan(pose(2, 5), pose(6.3, 5), 1.0F).poses.empty());  // 0.3 m inside the block
}

/// Another nav_node, which never gets an OctoMap.
TEST(NavNodeWithoutOctoMap, takes_an_occupancy_grid) {
  ros::NodeHandle node("grid");
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.width = 200;
  map.info.height = 120;
  map.info.resolution = 0.1F;
  map.info.origin.position.x = -5.0;
  map.info.origin.orientation.w = 1.0;
  map.data.assign(200 * 120, 0);
  for (std::size_t y = 30; y < 90; ++y) map.data[y * 200 + 100] = 100;  // a wall at x = 5
  ros::Publisher maps = node.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  ros::ServiceClient client = node.serviceClient<nav_msgs::GetPlan>("move_base/make_plan");
  ASSERT_TRUE(client.waitForExistence(ros::Duration(10.0)));
  nav_msgs::GetPlan service;
  service.request.start.header.frame_id = service.request.goal.header.frame_id = "map";
  service.request.start.pose.position.x = 1.0;
  service.request.goal.pose.position.x = 9.0;
  service.request.start.pose.position.y = service.request.goal.pose.position.y = 6.0;
  EXPECT_FALSE(client.call(service)) << "there is no map yet";
  maps.publish(map);
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (!client.call(service) && ros::WallTime::now() < end) ros::WallDuration(0.1).sleep();
  EXPECT_GE(service.response.plan.poses.size(), 3U);
}

TEST_F(NavNodeTest, takes_a_full_map_on_the_same_topic) {
  send_map();
  send_goal(14, 6);
  ASSERT_TRUE(until([this] {
    return guidance_.state == navvi_msgs::Guidance::FOLLOWING && guidance_.goal.y == 6.0;
  }));
  send_map(true);
  EXPECT_TRUE(
      until([this] { return guidance_.replan_reason == navvi_msgs::Guidance::MAP_CHANGED; }));
  EXPECT_TRUE(until([this] {
    return !path_.poses.empty() &&
           std::all_of(path_.poses.begin(), path_.poses.end(),
                       [](const auto& pose) { return pose.pose.position.y < 6.5; });
  }));
}

TEST_F(NavNodeTest, T4_tells_what_zones_allow_of_each_pose_once) {
  int told = 0;
  const ros::Subscriber reader = node_.subscribe<navvi_msgs::Zone>(
      "navvi/zone", 10, [&](const navvi_msgs::Zone::ConstPtr&) { ++told; });
  EXPECT_TRUE(until([&] { return told > 10; }));
  poses_ = false;
  const auto told_for = [&](double seconds) {
    const int before = told;
    const ros::WallTime begun = ros::WallTime::now();
    until([&] { return (ros::WallTime::now() - begun).toSec() > seconds; });
    return told - before;
  };
  told_for(0.2);  // what is on its way
  EXPECT_LE(told_for(0.5), 1) << "of a pose that is still taken for fresh";
  poses_ = true;
  EXPECT_TRUE(until([&, before = told] { return told > before + 5; }));
}

TEST_F(NavNodeTest, T4_one_transform_from_the_future_is_no_pose_and_keeps_out_none_that_follow) {
  ASSERT_TRUE(lead());
  // At the goal, it says, by a clock that is days ahead.
  broadcaster_.sendTransform(robot_at(14.0, ros::Time::now() + ros::Duration(1e6)));
  const ros::WallTime sent = ros::WallTime::now();
  EXPECT_TRUE(until([&] {
    EXPECT_NE(guidance_.state, navvi_msgs::Guidance::ARRIVED);
    return (ros::WallTime::now() - sent).toSec() > 3.0;
  }));
  EXPECT_EQ(guidance_.state, navvi_msgs::Guidance::FOLLOWING);
  EXPECT_GT(guidance_.goal_distance, 12.0) << "from where the robot is";
  // Where nothing else tells the place, it is lost, and that is told.
  poses_ = false;
  broadcaster_.sendTransform(robot_at(14.0, ros::Time::now() + ros::Duration(1e6)));
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::POSE_STALE; }));
  poses_ = true;
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; }));
}

TEST_F(NavNodeTest, T4_a_transform_1_s_ahead_is_no_pose_when_its_time_has_come_either) {
  ASSERT_TRUE(lead());
  for (int i = 0; i < 3; ++i)
    broadcaster_.sendTransform(robot_at(13.0, ros::Time::now() + ros::Duration(1.0 + 0.01 * i)));
  double nearest = guidance_.goal_distance;
  const ros::WallTime sent = ros::WallTime::now();
  until([&] {
    nearest = std::min(nearest, guidance_.goal_distance);
    return (ros::WallTime::now() - sent).toSec() > 2.5;
  });
  EXPECT_GT(nearest, 12.0) << "from where the robot is";
  EXPECT_EQ(guidance_.state, navvi_msgs::Guidance::FOLLOWING);
}

TEST_F(NavNodeTest, T1_knows_pose_and_obstacles_within_1_s_of_a_jump_back_and_goes_on) {
  ASSERT_TRUE(lead());
  poses_ = false;
  bool corrects = true;  // the localizer, once; odometry all the time
  moves_ = [&] {
    geometry_msgs::TransformStamped place = robot_at(pose_x_, ros::Time::now());
    place.child_frame_id = "odom";
    if (std::exchange(corrects, false)) broadcaster_.sendTransform(place);
    place = robot_at(0.0, place.header.stamp);
    place.header.frame_id = "odom";
    place.transform.translation.y = 0.0;
    broadcaster_.sendTransform(place);
  };
  ASSERT_TRUE(until([&] { return !corrects; }));
  const ros::Time before = ros::Time::now();
  clock_ahead -= 97.0;
  ASSERT_TRUE(until([&] {
    return guidance_.state == navvi_msgs::Guidance::POSE_STALE && guidance_.header.stamp < before;
  }));
  corrects = true;
  const auto sent = navvi_test::Clock::now();
  const auto leads = [this] {
    return guidance_.state == navvi_msgs::Guidance::FOLLOWING && guidance_.detail.empty();
  };
  EXPECT_TRUE(until(leads));
  navvi_test::expect_within(1000, sent, "led again");
  const ros::WallTime led = ros::WallTime::now();
  EXPECT_TRUE(until([&] { return (ros::WallTime::now() - led).toSec() > 3.0; }));
  EXPECT_TRUE(leads()) << "by the place that the localizer told last";
}

TEST_F(NavNodeTest, T4_an_arrival_that_odometry_contradicts_is_a_lost_position) {
  send_map();
  send_goal(14, 5.3);
  ASSERT_TRUE(until([this] {
    return guidance_.state == navvi_msgs::Guidance::FOLLOWING && guidance_.goal.y == 5.3;
  }));
  pose_x_ = 14.0;
  EXPECT_TRUE(until([this] {
    EXPECT_NE(guidance_.state, navvi_msgs::Guidance::ARRIVED);
    return guidance_.state == navvi_msgs::Guidance::POSE_STALE;
  }));
  odometry_x_ = 13.5;
  EXPECT_TRUE(until([this] { return guidance_.state == navvi_msgs::Guidance::ARRIVED; }));
}

TEST_F(NavNodeTest, T4_transforms_that_are_no_numbers_or_no_rotation_end_nothing) {
  ASSERT_TRUE(lead());
  geometry_msgs::TransformStamped bad = robot_at(2.0, ros::Time::now());
  bad.transform.rotation.w = std::numeric_limits<double>::quiet_NaN();
  broadcaster_.sendTransform(bad);
  bad.transform.rotation.w = 0.0;
  broadcaster_.sendTransform(bad);
  bad = robot_at(std::numeric_limits<double>::infinity(), ros::Time::now());
  broadcaster_.sendTransform(bad);
  bad = robot_at(2.0, ros::Time::now());
  bad.child_frame_id = bad.header.frame_id;
  broadcaster_.sendTransform(bad);
  const unsigned before = guidance_.seq;
  EXPECT_TRUE(until([&] { return guidance_.seq > before + 10; }));
  EXPECT_EQ(guidance_.state, navvi_msgs::Guidance::FOLLOWING);
}

TEST_F(NavNodeTest, N6_more_obstacles_than_a_message_may_hold_are_announced) {
  ASSERT_TRUE(lead());
  navvi_msgs::Obstacle one;
  one.thing_class = "box";
  one.pose.orientation.w = 1.0;
  one.radius = 0.1;
  one.height = 1.0;
  played_.obstacles.assign(10001, one);
  const auto sent = navvi_test::Clock::now();
  EXPECT_TRUE(until(
      [this] { return guidance_.detail.find("the obstacles are rejected") != std::string::npos; }));
  navvi_test::expect_within(2000, sent, "rejected");
  played_.obstacles.clear();
  EXPECT_TRUE(until(
      [this] { return guidance_.detail.find("the obstacles are rejected") == std::string::npos; }));
}

TEST_F(NavNodeTest, drops_obstacles_of_another_time_and_announces_that_none_come) {
  ASSERT_TRUE(lead());
  const auto missing = [this] { return guidance_.detail.find("no fresh obstacles") == 0; };
  for (const double age : {5.0, -1.0}) {
    EXPECT_TRUE(until([&] { return !missing(); })) << age;
    obstacles_age_ = age;
    EXPECT_TRUE(until(missing)) << age;
    obstacles_age_.reset();
  }
  EXPECT_TRUE(until([&] { return !missing(); })) << "without a stamp";
}

TEST_F(NavNodeTest, takes_its_goal_as_an_action_as_move_base_does) {
  using State = actionlib::SimpleClientGoalState;
  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client(node_, "move_base", false);
  send_map();
  ASSERT_TRUE(until([&] { return client.isServerConnected() && !mesh_.markers.empty(); }));
  double seen = 0.0;
  const auto ask = [&](double x, const std::string& frame = "map") {
    move_base_msgs::MoveBaseGoal goal;
    goal.target_pose.header.frame_id = frame;
    goal.target_pose.pose.position.x = x;
    goal.target_pose.pose.position.y = 5.0;
    goal.target_pose.pose.orientation.w = 1.0;
    client.sendGoal(goal, {}, {}, [&](const move_base_msgs::MoveBaseFeedbackConstPtr& feedback) {
      seen = feedback->base_position.pose.position.x;
    });
  };
  const auto ends_as = [&](State::StateEnum state) {
    return until([&] { return client.getState() == state; });
  };
  ask(14.0);
  EXPECT_TRUE(until([&] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; }));
  EXPECT_TRUE(until([&] { return seen == 2.0; })) << "where the robot is";
  client.cancelGoal();
  EXPECT_TRUE(ends_as(State::PREEMPTED));
  EXPECT_TRUE(until([&] { return guidance_.state == navvi_msgs::Guidance::NO_GOAL; }));
  ask(7.5);
  EXPECT_TRUE(ends_as(State::ABORTED)) << "in a shelf";
  EXPECT_FALSE(client.getState().getText().empty());
  ask(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(ends_as(State::ABORTED));
  ask(14.0);
  EXPECT_TRUE(until([&] { return guidance_.state == navvi_msgs::Guidance::FOLLOWING; }));
  send_goal(13.0, 5.0);
  EXPECT_TRUE(ends_as(State::PREEMPTED)) << "another goal took its place";
  ask(2.1, "nowhere");
  EXPECT_TRUE(ends_as(State::ABORTED)) << "and the goal before it stands";
  EXPECT_EQ(client.getState().getText(), "the goal's frame is not known");
  EXPECT_EQ(guidance_.state, navvi_msgs::Guidance::FOLLOWING);
  ask(14.0);
  EXPECT_TRUE(until([&] { return client.getState() == State::ACTIVE; }));
  send_goal(std::numeric_limits<double>::quiet_NaN(), 5.0);
  for (int i = 0; i < 3; ++i) {
    seen = 0.0;
    EXPECT_TRUE(until([&] { return seen == 2.0; }));
  }
  EXPECT_EQ(client.getState(), State::ACTIVE) << "what cannot be read takes no goal's place";
  ask(2.1);
  EXPECT_TRUE(ends_as(State::SUCCEEDED)) << "the robot is there";
}

TEST_F(NavNodeTest, sends_a_goal_of_another_frame_again_in_map_for_all_who_read_goals) {
  using State = actionlib::SimpleClientGoalState;
  geometry_msgs::TransformStamped dock;
  dock.header.stamp = ros::Time::now();
  dock.header.frame_id = "map";
  dock.child_frame_id = "dock";
  dock.transform.translation.x = 13.0;
  dock.transform.translation.y = 4.0;
  dock.transform.rotation.w = 1.0;
  tf2_ros::StaticTransformBroadcaster docks;
  docks.sendTransform(dock);
  std::optional<geometry_msgs::PoseStamped> heard;  // by trial_node and feedback_node
  const auto hear = [&](const geometry_msgs::PoseStamped::ConstPtr& msg) {
    if (msg->header.frame_id == "map") heard = *msg;
  };
  const ros::Subscriber reader =
      node_.subscribe<geometry_msgs::PoseStamped>("move_base_simple/goal", 10, hear);
  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client(node_, "move_base", false);
  send_map();
  ASSERT_TRUE(until([&] { return client.isServerConnected() && !mesh_.markers.empty(); }));
  for (const bool action : {false, true}) {
    heard.reset();
    ASSERT_TRUE(until([&, sent = ros::WallTime()]() mutable {
      if ((ros::WallTime::now() - sent).toSec() > 0.5 && !heard) {  // until the frame is known
        sent = ros::WallTime::now();
        move_base_msgs::MoveBaseGoal goal;
        goal.target_pose.header.frame_id = "dock";
        goal.target_pose.pose.position.x = goal.target_pose.pose.position.y = 1.0;
        goal.target_pose.pose.orientation.w = 1.0;
        if (action)
          client.sendGoal(goal);
        else
          send_goal(1.0, 1.0, "dock");
      }
      return heard.has_value();
    })) << action;
    EXPECT_EQ(heard->pose.position.x, 14.0);
    EXPECT_EQ(heard->pose.position.y, 5.0);
    EXPECT_TRUE(until([&] { return guidance_.goal.x == 14.0 && guidance_.goal.y == 5.0; }));
  }
  EXPECT_EQ(client.getState(), State::ACTIVE);
  client.cancelGoal();
  EXPECT_TRUE(until([&] { return client.getState() == State::PREEMPTED; }));
}

TEST_F(NavNodeTest, N9_lives_on_after_garbage) {
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
