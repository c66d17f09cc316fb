#include "navvi_nav/navigator.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "small_world.hpp"

namespace navvi_nav {
namespace {

constexpr double kTick = 0.05;  // s

std::shared_ptr<const MapMessage> message_of(SmallWorld& world) {
  std::ostringstream out;
  octomap::OcTree tree = world.tree();
  tree.writeBinaryData(out);
  const std::string text = out.str();
  MapMessage message;
  message.data.assign(text.begin(), text.end());
  message.id = "OcTree";
  message.resolution = tree.getResolution();
  return std::make_shared<const MapMessage>(message);
}

/// Navigator and planner in lockstep: each job is done within the tick.
class Lockstep : public testing::Test {
 protected:
  Lockstep() { world_.room(16, 10).box(6, 3, 0, 9, 7, 1.0); }

  void load() {
    navigator_.set_map(message_of(world_));
    tick();
  }
  void tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      time_ += kTick;
      if (has_pose_) navigator_.set_pose(robot_, time_);
      navigator_.set_speed(speed_);
      if (has_obstacles_) navigator_.set_obstacles(obstacles_, time_);
      if (const auto job = navigator_.update(time_)) {
        last_ = work(planner_, *job);
        navigator_.deliver(*last_, time_);
      }
    }
  }
  /// Moves the robot straight at the next way-point.
  void drive(double step) {
    const Heading heading = status().heading;
    robot_.yaw -= heading.waypoint_angle;
    const double length = std::min(step, heading.waypoint_distance);
    robot_.position = to_parent(robot_, {length, 0.0});
    tick();
  }
  [[nodiscard]] Status status() const { return navigator_.status(time_); }

  SmallWorld world_;
  NavigatorConfig config_;
  Navigator navigator_{config_};
  Planner planner_{config_.planner};
  std::optional<Outcome> last_;
  std::vector<Cylinder> obstacles_;
  Pose robot_{{2, 5}, 0.0};
  bool has_pose_ = true;
  bool has_obstacles_ = true;
  double speed_ = 0.5;
  double time_ = 100.0;
};

TEST_F(Lockstep, says_no_map_before_one_came) {
  navigator_.set_goal({14, 5});
  tick(3);
  EXPECT_EQ(status().state, State::no_map);
}

TEST_F(Lockstep, says_pose_stale_without_a_pose_and_recovers) {
  has_pose_ = false;
  load();
  navigator_.set_goal({14, 5});
  tick(3);
  EXPECT_EQ(status().state, State::pose_stale);
  has_pose_ = true;
  tick(2);
  EXPECT_EQ(status().state, State::following);
  has_pose_ = false;
  tick(25);
  EXPECT_EQ(status().state, State::pose_stale);
}

TEST_F(Lockstep, keeps_the_last_good_map_when_a_broken_one_comes) {
  load();
  MapMessage broken = *message_of(world_);
  broken.data.resize(broken.data.size() / 2);
  navigator_.set_map(std::make_shared<const MapMessage>(broken));
  tick();
  EXPECT_FALSE(last_->map_error.empty());
  navigator_.set_goal({14, 5});
  tick(2);
  EXPECT_EQ(status().state, State::following);
}

TEST_F(Lockstep, refuses_a_goal_inside_an_obstacle_and_shows_no_path) {
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  ASSERT_FALSE(navigator_.path().empty());
  navigator_.set_goal({7, 5});
  tick(2);
  EXPECT_EQ(status().state, State::goal_refused);
  EXPECT_EQ(status().refusal, Refusal::inside_obstacle);
  EXPECT_TRUE(navigator_.path().empty());
  tick(60);
  EXPECT_EQ(status().state, State::goal_refused);
}

TEST_F(Lockstep, keeps_a_standing_goal_when_a_goal_that_cannot_be_read_comes) {
  load();
  EXPECT_FALSE(navigator_.drop_bad_goal(Refusal::not_finite, "not finite"));
  EXPECT_EQ(status().state, State::goal_refused);
  EXPECT_EQ(status().refusal, Refusal::not_finite);
  navigator_.set_goal({14, 5});
  tick(2);
  const Path before = navigator_.path();
  EXPECT_TRUE(navigator_.drop_bad_goal(Refusal::unknown_frame, "no such frame"));
  tick(2);
  EXPECT_EQ(status().state, State::following);
  EXPECT_EQ(status().refusal, Refusal::none);
  EXPECT_EQ(navigator_.path(), before);
}

TEST_F(Lockstep, says_while_no_fresh_obstacles_come) {
  const std::string said = "no fresh obstacles: moving things are not in the path";
  has_obstacles_ = false;
  load();
  navigator_.set_goal({14, 5});
  tick(40);
  EXPECT_EQ(status().detail, said);
  EXPECT_FALSE(navigator_.obstacles_lost());  // none came yet, so none are lost
  has_obstacles_ = true;
  tick();
  EXPECT_EQ(status().detail, "");
  has_obstacles_ = false;
  tick(40);
  EXPECT_EQ(status().state, State::following);
  EXPECT_EQ(status().detail, said);
  EXPECT_TRUE(navigator_.obstacles_lost());
}

TEST_F(Lockstep, leads_around_the_block_and_arrives) {
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  EXPECT_EQ(status().reason, Reason::new_goal);
  int steps = 0;
  while (status().state == State::following && steps < 1000) {
    drive(0.05);
    ++steps;
    const double gap = planner_.nav_mesh().space().clearance(robot_.position);
    ASSERT_GE(gap, 0.3) << robot_.position.x << " " << robot_.position.y;
  }
  EXPECT_EQ(status().state, State::arrived);
  EXPECT_LT(distance(robot_.position, {14, 5}), 1.0);
  EXPECT_TRUE(navigator_.path().empty());
  tick(100);
  EXPECT_EQ(status().state, State::arrived);
}

TEST_F(Lockstep, plans_around_an_obstacle_that_cuts_the_path) {
  load();
  navigator_.set_goal({14, 5});
  tick(12);
  const Path before = navigator_.path();
  const Point middle = 0.5 * (before[1] + before[2]);
  obstacles_ = {{1, middle, 0.4, {}}};
  tick(2);
  EXPECT_TRUE(status().reason == Reason::path_carved ||
              status().reason == Reason::waypoint_blocked);
  EXPECT_EQ(status().state, State::following);
  for (const Point point : points_along(navigator_.path(), 0.02))
    EXPECT_GE(distance(point, middle), 0.75 - 1e-6);
}

TEST_F(Lockstep, does_not_change_a_free_path_every_period) {
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  const Path before = navigator_.path();
  robot_.position = robot_.position + Point{0.1, 0.05};
  tick(200);
  EXPECT_GT(status().plans, 4U);
  EXPECT_EQ(navigator_.path(), before);
}

TEST_F(Lockstep, says_no_route_while_the_way_is_blocked_and_finds_it_again) {
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  obstacles_ = {{1, {7.5, 1.5}, 1.4, {}}, {2, {7.5, 8.5}, 1.4, {}}};
  tick(50);
  EXPECT_EQ(status().state, State::no_route);
  EXPECT_TRUE(navigator_.path().empty());
  obstacles_.clear();
  tick(50);
  EXPECT_EQ(status().state, State::following);
}

TEST_F(Lockstep, keeps_the_path_while_only_something_far_ahead_closes_it) {
  config_.replan.look_ahead = 2.0;
  navigator_ = Navigator(config_);
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  obstacles_ = {{1, {7.5, 1.5}, 1.4, {}}, {2, {7.5, 8.5}, 1.4, {}}};
  tick(100);
  EXPECT_GT(status().plans, 1U);
  EXPECT_EQ(status().state, State::following);
  robot_.position = navigator_.path()[1];
  tick(100);
  EXPECT_EQ(status().state, State::no_route);
}

TEST_F(Lockstep, waits_for_a_forklift_that_crosses_before_it_goes_round_by_the_other_aisle) {
  world_.box(6, 1.5, 0, 13, 8.5, 1.0);
  robot_.position = {2, 1.5};
  load();
  navigator_.set_goal({14.5, 1.2});
  tick(2);
  const Path before = navigator_.path();
  ASSERT_LT(length_of(before), 13.5);
  obstacles_ = {{1, {9.5, 0.8}, 0.6, {0.0, 1.0}}};
  tick(70);
  EXPECT_EQ(navigator_.path(), before);
  EXPECT_EQ(status().state, State::following);
  tick(30);
  EXPECT_GT(length_of(navigator_.path()), 18.0);
}

TEST_F(Lockstep, goes_round_at_once_when_what_cuts_the_path_stands) {
  world_.box(6, 1.5, 0, 13, 8.5, 1.0);
  robot_.position = {2, 1.5};
  load();
  navigator_.set_goal({14.5, 1.2});
  tick(2);
  obstacles_ = {{1, {9.5, 0.8}, 0.6, {}}};
  tick(15);
  EXPECT_GT(length_of(navigator_.path()), 18.0);
}

TEST_F(Lockstep, plans_again_when_the_map_changed) {
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  world_.box(6, 7, 0, 9, 10, 1.0);
  navigator_.set_map(message_of(world_));
  tick(2);
  EXPECT_EQ(status().reason, Reason::map_changed);
  EXPECT_EQ(status().state, State::following);
  for (const Point point : navigator_.path()) EXPECT_LT(point.y, 6.0);
}

TEST_F(Lockstep, survives_time_jumping_back) {
  load();
  navigator_.set_goal({14, 5});
  tick(2);
  time_ = 1.0;
  navigator_.reset_times();
  EXPECT_EQ(status().state, State::pose_stale);
  tick(60);
  EXPECT_EQ(status().state, State::following);
}

TEST(Guidance, measures_angles_clockwise_from_the_nose) {
  EXPECT_NEAR(clockwise({1, 0}, {0, -1}), M_PI / 2, 1e-12);
  EXPECT_NEAR(clockwise({1, 0}, {0, 1}), -M_PI / 2, 1e-12);
  Guidance guidance{GuidanceConfig{}};
  guidance.follow({{0, 0}, {4, 0}, {4, -4}});
  const Heading heading = guidance.heading({{0, 1}, 0.0});
  EXPECT_NEAR(heading.turn_angle, M_PI / 2 - std::atan2(1, 4), 1e-12);
  EXPECT_NEAR(heading.waypoint_angle, std::atan2(1, 4), 1e-12);
  EXPECT_NEAR(heading.path_offset, 1.0, 1e-12);
  EXPECT_NEAR(heading.goal_distance, std::hypot(4, 1) + 4, 1e-12);
}

TEST(Guidance, keeps_a_corner_that_would_be_cut_through_a_shelf) {
  SmallWorld world;
  world.room(8, 8).box(2, 2, 0, 4, 6, 1.0);
  NavMesh mesh(NavMeshConfig{});
  ASSERT_EQ(mesh.set_map(world.tree()).error, "");
  Guidance guidance{GuidanceConfig{}};
  guidance.follow({{1.2, 1.0}, {1.2, 6.6}, {4.6, 6.6}, {4.6, 1.0}});
  guidance.advance({{1.2, 5.7}, 0.0}, mesh.space());
  EXPECT_EQ(guidance.next_waypoint(), (Point{1.2, 6.6}));  // within 1 m, but round the corner
  guidance.advance({{1.2, 6.5}, 0.0}, mesh.space());
  EXPECT_EQ(guidance.next_waypoint(), (Point{4.6, 6.6}));
}

TEST(Guidance, does_not_arrive_through_a_wall) {
  SmallWorld world;
  world.room(8, 8).box(4, 0, 0, 4.05, 6, 1.0);
  NavMesh mesh(NavMeshConfig{});
  ASSERT_EQ(mesh.set_map(world.tree()).error, "");
  Guidance guidance{GuidanceConfig{}};
  guidance.follow({{3.58, 2}, {4, 7}, {4.47, 2}});
  EXPECT_FALSE(guidance.arrived({{3.58, 2}, 0.0}, mesh.space()));
  EXPECT_TRUE(guidance.arrived({{4.47, 2.8}, 0.0}, mesh.space()));
}

}  // namespace
}  // namespace navvi_nav

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
