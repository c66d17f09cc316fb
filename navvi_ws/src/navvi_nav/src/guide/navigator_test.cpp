#include "guide/navigator.hpp"

#include <gtest/gtest.h>

#include "lockstep.hpp"

namespace navvi_nav::guide {
namespace {

TEST_F(Lockstep, says_no_map_before_one_came) {
  navigator_.set_goal({14, 5});
  tick(3);
  EXPECT_EQ(status().state, Guidance::State::no_map);
}

TEST_F(Lockstep, says_pose_stale_without_a_pose_and_recovers) {
  has_pose_ = false;
  lead({14, 5});
  tick();
  EXPECT_EQ(status().state, Guidance::State::pose_stale);
  has_pose_ = true;
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
  has_pose_ = false;
  tick(25);
  EXPECT_EQ(status().state, Guidance::State::pose_stale);
}

TEST_F(Lockstep, N9_keeps_the_last_good_map_when_a_broken_one_comes) {
  load();
  plan::MapMessage broken = *message_of(world_);
  broken.data.resize(broken.data.size() / 2);
  navigator_.set_map(std::make_shared<const plan::MapMessage>(broken));
  tick();
  EXPECT_FALSE(last_->map_error.empty());
  navigator_.set_goal({14, 5});
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Lockstep, N3_refuses_a_goal_inside_an_obstacle_and_shows_no_path) {
  lead({14, 5});
  ASSERT_FALSE(navigator_.path().empty());
  navigator_.set_goal({7, 5});
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
  EXPECT_EQ(status().refusal, Guidance::Refusal::inside_obstacle);
  EXPECT_TRUE(navigator_.path().empty());
  tick(60);
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
}

TEST_F(Lockstep, N5_keeps_a_standing_goal_when_a_goal_that_cannot_be_read_comes) {
  load();
  EXPECT_FALSE(navigator_.drop_bad_goal(Guidance::Refusal::not_finite, "not finite"));
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
  EXPECT_EQ(status().refusal, Guidance::Refusal::not_finite);
  navigator_.set_goal({14, 5});
  tick(2);
  const Path before = navigator_.path();
  EXPECT_TRUE(navigator_.drop_bad_goal(Guidance::Refusal::unknown_frame, "no such frame"));
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_EQ(status().refusal, Guidance::Refusal::none);
  EXPECT_EQ(navigator_.path(), before);
}

TEST_F(Lockstep, N6_says_at_once_that_obstacles_are_rejected) {
  const std::string said = "the obstacles are rejected, as malformed or too many";
  lead({14, 5});
  navigator_.reject_obstacles();
  EXPECT_EQ(status().detail, said);
  has_obstacles_ = false;
  tick(40);
  EXPECT_EQ(status().detail, said + ": moving things are not in the path");
  has_obstacles_ = true;
  tick();
  EXPECT_EQ(status().detail, "");
}

TEST_F(Lockstep, says_while_no_fresh_obstacles_come) {
  const std::string said = "no fresh obstacles: moving things are not in the path";
  has_obstacles_ = false;
  lead({14, 5});
  tick(38);
  EXPECT_EQ(status().detail, said);
  EXPECT_FALSE(navigator_.obstacles_lost());  // none came yet, so none are lost
  has_obstacles_ = true;
  tick();
  EXPECT_EQ(status().detail, "");
  has_obstacles_ = false;
  tick(40);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_EQ(status().detail, said);
  EXPECT_TRUE(navigator_.obstacles_lost());
}

TEST_F(Lockstep, without_a_goal_never_plans) {
  load();
  tick(100);
  EXPECT_EQ(status().plans, 0U);
  EXPECT_FALSE(last_->plan);
  EXPECT_EQ(status().state, Guidance::State::no_goal);
}

TEST_F(Lockstep, leads_around_the_block_and_arrives) {
  lead({14, 5});
  EXPECT_EQ(status().replan_reason, Guidance::Replan::new_goal);
  int steps = 0;
  while (status().state == Guidance::State::following && steps < 1000) {
    drive(0.05);
    ++steps;
    const double gap = planner_.nav_mesh().space().clearance(robot_.position);
    ASSERT_GE(gap, 0.3) << robot_.position.x << " " << robot_.position.y;
  }
  EXPECT_EQ(status().state, Guidance::State::arrived);
  EXPECT_LT(distance(robot_.position, {14, 5}), 1.0);
  EXPECT_TRUE(navigator_.path().empty());
  tick(100);
  EXPECT_EQ(status().state, Guidance::State::arrived);
}

/// A robot of 0.6 m radius in two aisles of 1.3 m about a corner.
class WideRobot : public Lockstep {
 protected:
  WideRobot() : Lockstep(10, 10, of_radius(0.6)) {
    world_.box(0.1, 1.4, 0, 8.6, 9.9, 1.0);
    robot_.position = {1.5, 0.75};
  }
  static NavigatorConfig of_radius(double radius) {
    NavigatorConfig config;
    config.planner.mesh.robot_radius = radius;
    return config;
  }
};

TEST_F(WideRobot, is_led_round_a_corner_and_not_into_it) {
  lead({9.25, 8});
  double least = 1e9;
  for (int i = 0; i < 1000 && status().state == Guidance::State::following; ++i) {
    drive(0.05);
    least = std::min(least, planner_.nav_mesh().space().clearance(robot_.position));
  }
  EXPECT_EQ(status().state, Guidance::State::arrived);
  EXPECT_GE(least, 0.55);
}

TEST_F(Lockstep, T4_arrives_only_where_odometry_agrees) {
  lead({14, 5});
  navigator_.set_odometry_place(Eigen::Vector2d(2.0, 5.0));
  robot_.position = {14, 5};
  tick(20);
  EXPECT_EQ(status().state, Guidance::State::pose_stale);
  EXPECT_EQ(status().detail, "the pose is at the goal, and odometry is not");
  has_odometry_ = false;
  tick(22);
  EXPECT_EQ(status().state, Guidance::State::pose_stale);
  EXPECT_EQ(status().detail, "the pose is at the goal, and odometry is silent");
  has_odometry_ = true;
  robot_.position = {11, 5};
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following) << "the pose was a false one";
  navigator_.set_odometry_place(Eigen::Vector2d(13.0, 5.0));
  robot_.position = {13.4, 5};
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::arrived);
}

TEST_F(Lockstep, H6_never_steers_through_what_stands_after_a_localizer_corrected_the_pose) {
  lead({14, 5});
  for (const double y : {2.4, 7.6, 2.4}) {  // beside the block, on either side
    robot_.position = {7.5, y};
    int said = 0;
    for (int i = 0; i < 15; ++i) {
      tick();
      if (navigator_.undecided(time_)) continue;
      ++said;
      const double angle = -status().steer_angle;
      const Point ahead = robot_.position + 0.8 * Point{std::cos(angle), std::sin(angle)};
      EXPECT_TRUE(planner_.nav_mesh().space().floor->segment_clear(robot_.position, ahead, 0.0))
          << y << " " << i << " " << angle;
    }
    EXPECT_GE(said, 4) << "at most half a second goes by";
  }
}

TEST_F(Lockstep, plans_around_an_obstacle_that_cuts_the_path) {
  lead({14, 5});
  tick(10);
  const Path before = navigator_.path();
  const Point middle = 0.5 * (before[1] + before[2]);
  obstacles_ = {{1, middle, 0.4, {}}};
  tick(2);
  EXPECT_TRUE(status().replan_reason == Guidance::Replan::path_carved ||
              status().replan_reason == Guidance::Replan::waypoint_blocked);
  EXPECT_EQ(status().state, Guidance::State::following);
  for (const Point point : points_along(navigator_.path(), 0.02))
    EXPECT_GE(distance(point, middle), 0.75 - 1e-6);
}

TEST_F(Lockstep, N2_hides_a_path_that_must_change_when_no_plan_came_in_time) {
  lead({14, 5});
  tick(10);
  const Path before = navigator_.path();
  obstacles_ = {{1, 0.5 * (before[1] + before[2]), 0.4, {}}};
  const auto asked = ask();
  ASSERT_TRUE(asked && asked->goal);
  for (int i = 0; i < 20; ++i) ASSERT_FALSE(ask()) << "the planner is at work";
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_EQ(navigator_.path(), before);
  for (int i = 0; i < 2; ++i) ASSERT_FALSE(ask());
  EXPECT_EQ(status().state, Guidance::State::no_route);
  EXPECT_EQ(status().detail, "no plan came in time");
  EXPECT_TRUE(navigator_.path().empty());
  navigator_.deliver(planner_.answer(*asked), time_);
  EXPECT_EQ(status().state, Guidance::State::following) << "late, but there";
}

TEST_F(Lockstep, N2_tells_to_wait_for_what_crosses_while_the_planner_is_at_work) {
  lead({14, 5});
  std::optional<plan::PlanRequest> asked;
  while (!asked) asked = ask();
  ASSERT_FALSE(asked->goal) << "it learns what moves";
  const Point start = navigator_.path()[0];
  const Point leg = navigator_.path()[1] - start;
  const Point ahead = (1.0 / norm(leg)) * leg;
  const Point aside{-ahead.y, ahead.x};
  obstacles_ = {{1, start + 2.4 * ahead + 1.8 * aside, 0.4, -0.5 * aside}};
  for (int i = 0; i < 2; ++i) ASSERT_FALSE(ask());
  EXPECT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().blocked_by, class_of(1));
}

TEST_F(Lockstep, N2_hides_a_path_that_is_cut_while_the_planner_is_at_work_on_something_else) {
  lead({14, 5});
  std::optional<plan::PlanRequest> asked;
  while (!asked) asked = ask();
  ASSERT_FALSE(asked->goal);
  for (int i = 0; i < 30; ++i) ASSERT_FALSE(ask());
  EXPECT_EQ(status().state, Guidance::State::following) << "the path is free";
  const Point start = navigator_.path()[0];
  const Point leg = navigator_.path()[1] - start;
  obstacles_ = {{1, start + (2.0 / norm(leg)) * leg, 0.4, {}}};
  ASSERT_FALSE(ask());
  EXPECT_EQ(status().state, Guidance::State::no_route);
  EXPECT_EQ(status().detail, "no plan came in time");
  navigator_.deliver(planner_.answer(*asked), time_);
  tick(50);
  EXPECT_EQ(status().state, Guidance::State::following) << "round it";
}

TEST_F(Lockstep, does_not_change_a_free_path_every_period) {
  lead({14, 5});
  const Path before = navigator_.path();
  robot_.position = robot_.position + Point{0.1, 0.05};
  tick(200);
  EXPECT_EQ(status().plans, 1U);  // nothing could have changed it
  EXPECT_EQ(navigator_.path(), before);
  config_.replan.trigger.only_if_it_matters = false;
  navigator_ = Navigator(config_);
  lead({14, 5});
  const Path again = navigator_.path();
  robot_.position = robot_.position + Point{0.1, 0.05};
  tick(200);
  EXPECT_GT(status().plans, 4U);
  EXPECT_EQ(navigator_.path(), again);
}

TEST_F(Lockstep, tells_the_age_of_map_and_mesh) {
  tick();
  EXPECT_FALSE(status().map_age);
  EXPECT_FALSE(status().mesh_age);
  load();
  tick(100);
  EXPECT_NEAR(*status().map_age, 100 * kTick, kTick + 1e-9);
  EXPECT_LE(*status().mesh_age, config_.carve_period + kTick);
}

TEST_F(Lockstep, calls_the_map_stale_only_if_maps_may_age_and_recovers) {
  lead({14, 5});
  tick(98);
  EXPECT_EQ(status().state, Guidance::State::following);
  config_.map_timeout = 3.0;
  navigator_ = Navigator(config_);
  lead({14, 5});
  tick(38);
  EXPECT_EQ(status().state, Guidance::State::following);
  tick(40);
  EXPECT_EQ(status().state, Guidance::State::map_stale);
  load();
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Lockstep, tells_the_shortest_length_and_how_long_the_rest_takes) {
  lead({14, 5});
  const Guidance now = status();
  EXPECT_GT(now.shortest_length, 0.0);
  EXPECT_LT(now.shortest_length, length_of(navigator_.path()));
  EXPECT_GT(now.eta, now.goal_distance / 0.75);  // at 0.7 m/s as long as nobody drove
  speed_ = 0.3;
  tick(1000);
  EXPECT_NEAR(status().eta, status().goal_distance / 0.3, 2.0);
  speed_ = 0.0;
  tick(1000);
  EXPECT_NEAR(status().eta, status().goal_distance / 0.3, 2.0);
}

TEST_F(Lockstep, takes_an_occupancy_grid_until_an_octomap_came) {
  map::OccupancyGrid grid;
  grid.width = 160;
  grid.height = 100;
  grid.resolution = 0.1;
  grid.cells.assign(16000, 0);
  ASSERT_TRUE(navigator_.set_map(std::make_shared<const map::OccupancyGrid>(grid)));
  tick();
  navigator_.set_goal({14, 5});
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_EQ(navigator_.path().size(), 2U);
  load();
  tick(2);
  EXPECT_GT(navigator_.path().size(), 2U);
  EXPECT_FALSE(navigator_.set_map(std::make_shared<const map::OccupancyGrid>(grid)));
  tick(2);
  EXPECT_GT(navigator_.path().size(), 2U);
}

TEST_F(Lockstep, leads_on_to_what_closes_the_only_way_and_waits_before_it) {
  lead({14, 5});
  obstacles_ = {{1, {7.5, 1.5}, 1.4, {}}, {2, {7.5, 8.5}, 1.4, {}}};
  tick(50);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_FALSE(status().blocked_by);
  for (int i = 0; i < 400 && status().state == Guidance::State::following; ++i) drive(0.035);
  ASSERT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().blocked_by, class_of(robot_.position.y < 5 ? 1 : 2));
  EXPECT_NEAR(status().blocked_distance, 3.0, 0.3);
  EXPECT_FALSE(status().blocked_for);
  EXPECT_GT(status().goal_distance, 8.0);
  const Path path = navigator_.path();
  tick(100);
  EXPECT_EQ(status().state, Guidance::State::blocked);
  EXPECT_TRUE(navigator_.path() == path);
  obstacles_.clear();
  tick();
  EXPECT_EQ(status().state, Guidance::State::following);
  tick(50);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Lockstep, names_what_stands_on_the_goal) {
  load();
  obstacles_ = {{5, {14, 5}, 0.6, {}}};
  robot_.position = {11.5, 5};
  navigator_.set_goal({14, 5});
  tick(2);
  ASSERT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().blocked_by, class_of(5));
  obstacles_[0].center = {14, 8};
  tick(50);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Lockstep, waits_on_for_20_s_for_what_stood_there_when_obstacles_were_lost) {
  load();
  obstacles_ = {{5, {14, 5}, 0.6, {}}};
  robot_.position = {11.5, 5};
  navigator_.set_goal({14, 5});
  tick(2);
  ASSERT_EQ(status().state, Guidance::State::blocked);
  has_obstacles_ = false;
  tick(60);
  ASSERT_TRUE(navigator_.obstacles_lost());
  EXPECT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().blocked_by, class_of(5));
  obstacles_.clear();
  has_obstacles_ = true;
  tick(50);
  EXPECT_EQ(status().state, Guidance::State::following);
  obstacles_ = {{5, {14, 5}, 0.6, {}}};
  tick(50);
  has_obstacles_ = false;
  tick(395);
  EXPECT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().detail.find("not in the path"), std::string::npos) << status().detail;
  tick(50);
  EXPECT_EQ(status().state, Guidance::State::following);
  EXPECT_NE(status().detail.find("not in the path"), std::string::npos) << status().detail;
}

TEST_F(Lockstep, says_no_route_where_the_map_has_none) {
  lead({14, 5});
  ASSERT_EQ(status().state, Guidance::State::following);
  robot_.position = {7.5, 5};  // within the box
  tick(100);
  EXPECT_EQ(status().state, Guidance::State::off_mesh);
}

TEST_F(Lockstep, keeps_a_goal_that_one_map_parts_from_the_robot) {
  lead({14, 5});
  ASSERT_EQ(status().state, Guidance::State::following);
  SmallWorld parted;
  parted.room(16, 10).box(6, 0, 0, 9, 10, 1.0);
  navigator_.set_map(message_of(parted));
  tick(60);
  EXPECT_EQ(status().state, Guidance::State::no_route);
  EXPECT_TRUE(navigator_.path().empty());
  load();
  tick(2);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Lockstep, refuses_a_goal_that_maps_part_from_the_robot_for_20_s) {
  SmallWorld parted;
  parted.room(16, 10).box(6, 0, 0, 9, 10, 1.0);
  for (const int maps : {1, 5}) {  // of a mapper that sends changes alone, or goes on
    lead({14, 5});
    ASSERT_EQ(status().state, Guidance::State::following) << maps;
    for (int map = 0; map < maps; ++map) {
      navigator_.set_map(message_of(parted));
      tick(390 / maps);
      EXPECT_EQ(status().state, Guidance::State::no_route) << maps << " " << map;
    }
    tick(70);
    EXPECT_EQ(status().state, Guidance::State::goal_refused) << maps;
    EXPECT_EQ(status().refusal, Guidance::Refusal::unreachable) << maps;
  }
}

TEST_F(Lockstep, refuses_a_goal_that_maps_do_not_show_any_more_for_4_s) {
  lead({14, 5});
  SmallWorld shrunk;
  shrunk.room(10, 10);
  for (const bool again : {true, false}) {  // a map that shows it comes in time, or none
    ASSERT_EQ(status().state, Guidance::State::following);
    navigator_.set_map(message_of(shrunk));
    tick(70);
    EXPECT_EQ(status().state, Guidance::State::no_route);
    if (again) load();
    tick(30);
  }
  EXPECT_EQ(status().state, Guidance::State::goal_refused);
}

TEST_F(Lockstep, goes_on_asking_for_plans_while_a_map_is_baked) {
  load();
  navigator_.set_goal({14, 5});
  world_.box(6, 7, 0, 9, 10, 1.0);
  navigator_.set_map(message_of(world_));
  const auto map = ask();
  ASSERT_TRUE(map && map->brings_map());
  const auto asked = ask();
  ASSERT_TRUE(asked && asked->goal);
  const plan::PlanAnswer on_old = planner_.answer(*asked);
  navigator_.deliver(planner_.answer(*map), time_);
  navigator_.deliver(on_old, time_);
  EXPECT_GT(navigator_.path()[1].y, 7.0);
  tick(2);
  EXPECT_EQ(status().replan_reason, Guidance::Replan::map_changed);
  for (const Point point : navigator_.path()) EXPECT_LT(point.y, 6.0);
}

TEST_F(Lockstep, takes_the_level_on_which_the_robot_stands_and_waits_for_it) {
  SmallWorld slab;
  slab.floor(-6, -6, 6, 6).box(-4, -4, 0, 4, 4, 0.05);
  robot_.position = {-3, 0};
  has_pose_ = false;
  navigator_.set_map(message_of(slab));
  tick(10);
  EXPECT_FALSE(navigator_.has_map());
  EXPECT_EQ(status().state, Guidance::State::pose_stale);
  EXPECT_EQ(status().detail,
            "no fresh pose of the robot, whose height tells which level of the map is the floor");
  has_pose_ = true;
  height_ = 0.05;
  navigator_.set_goal({3, 0});
  tick(3);
  EXPECT_EQ(status().state, Guidance::State::following) << status().detail;
  EXPECT_NEAR(status().floor, 0.05, 1e-9);
  height_ = 0.0;  // as on a ramp: the floor stays
  slab.box(1, 1, 0.05, 2, 2, 1.0);
  navigator_.set_map(message_of(slab));
  tick(3);
  EXPECT_NEAR(status().floor, 0.05, 1e-9);
}

TEST_F(Lockstep, cuts_no_hole_for_what_moves_far_off) {
  load();
  obstacles_ = {{1, {14, 5}, 0.4, {1, 0}}, {2, {200, 5}, 0.4, {1, 0}}, {3, {200, 8}, 0.4, {}}};
  navigator_.set_goal({3, 8});
  tick(20);
  const std::vector<Cylinder>& carved = planner_.nav_mesh().carved();
  ASSERT_EQ(carved.size(), 2U);
  EXPECT_EQ(carved[0].id, 1U);
  EXPECT_EQ(carved[1].id, 3U);
}

TEST_F(Lockstep, survives_time_jumping_back) {
  lead({14, 5});
  jump(-1.0);
  EXPECT_EQ(status().state, Guidance::State::pose_stale);
  tick(60);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Lockstep, keeps_ages_where_time_jumps_back) {
  time_ = 1e9;
  load();
  tick(100);
  jump(-100.0);
  EXPECT_NEAR(*status().map_age, 100 * kTick, kTick + 1e-9) << "as of a map that came before";
  navigator_.set_map(message_of(world_));
  time_ += kTick;
  const auto request = navigator_.update(time_);
  ASSERT_TRUE(request && request->map);
  jump(-100.0);
  navigator_.deliver(planner_.answer(*request), time_);
  EXPECT_NEAR(*status().map_age, 0.0, 1e-6) << "of a map that was being baked";
}

TEST_F(Lockstep, calls_the_map_stale_where_time_jumps_back_too) {
  config_.map_timeout = 3.0;
  navigator_ = Navigator(config_);
  time_ = 1e9;
  lead({14, 5});
  jump(-100.0);
  tick(80);
  EXPECT_EQ(status().state, Guidance::State::map_stale);
}

/// A room of 16 x 10 m; the robot is to go along y = 5 from x = 2 to x = 14. What the planner finds
/// is put in its mouth.
class Guided : public Lockstep {
 protected:
  Guided() : Lockstep(16, 10) {
    config_.replan.trigger.only_if_it_matters = false;
    navigator_ = Navigator(config_);
    load();
    navigator_.set_goal({14, 5});
  }
  /// Something 0.8 m long that stands at (x, 5) and faces the robot.
  void put_before(double x) { things_ = {moving_thing({7, {x, 5}, 0.5, {}}, kPi, 0.8, 0.6)}; }
  /// Lets time pass; each search finds `path`.
  void finds(plan::PlanStatus status, const Path& path, double seconds) {
    const double end = time_ + seconds - 1e-9;
    while (time_ < end) {
      time_ += kTick;
      navigator_.set_pose({{robot_.position.x, robot_.position.y}, robot_.yaw}, 0.0, time_);
      std::vector<MovingThing> things = things_;
      for (const Cylinder& obstacle : obstacles_) things.push_back(moving_thing(obstacle));
      if (has_obstacles_) navigator_.set_obstacles(things, time_);
      const auto request = navigator_.update(time_);
      if (!request) continue;
      plan::PlanAnswer answer;
      if (request->brings_map()) answer = planner_.answer(*request);
      if (request->goal) {
        swept_area_ = request->swept_area;
        answer.plan = plan::Plan{};
        answer.plan->status = status;
        answer.plan->path = path;
        answer.plan->shortest = length_of(path);
      }
      navigator_.deliver(answer, time_);
    }
  }
  /// A robot before a thing that faces it for long enough, on its retreat.
  void retreat(const Path& path) {
    put_before(4.0);
    finds(plan::PlanStatus::closed, straight_, 10.0);
    ASSERT_TRUE(swept_area_.empty());
    finds(plan::PlanStatus::retreat, path, 2.5);
    ASSERT_FALSE(swept_area_.empty());
    ASSERT_EQ(navigator_.path(), path);
  }
  std::vector<Cylinder> swept_area_;  // of the last request for a path
  const Path straight_{{2, 5}, {14, 5}};
};

TEST_F(Guided, retreats_from_what_it_faces_waits_there_and_arrives_nowhere) {
  const Path path{{2, 5}, {2, 7}};
  retreat(path);
  EXPECT_EQ(status().state, Guidance::State::make_room);
  EXPECT_EQ(status().blocked_by, class_of(7));
  EXPECT_FALSE(status().waypoint_is_goal);
  EXPECT_NEAR(status().goal_distance, 2.0 + std::hypot(12.0, 2.0), 1e-9) << "and not 2 m";
  robot_.position = {2, 5.75};
  finds(plan::PlanStatus::retreat, path, 1.0);
  EXPECT_EQ(status().state, Guidance::State::make_room);
  robot_.position = {2, 6.9};
  finds(plan::PlanStatus::closed, {{2, 6.9}, {14, 5}}, 3.0);
  EXPECT_EQ(status().state, Guidance::State::blocked);
  EXPECT_EQ(status().blocked_by, class_of(7));
  EXPECT_FALSE(status().blocked_for);
  EXPECT_EQ(status().reroutes, 0U);
  EXPECT_TRUE(swept_area_.empty());
  things_.clear();
  finds(plan::PlanStatus::found, {{2, 6.9}, {14, 5}}, 2.5);
  EXPECT_EQ(status().state, Guidance::State::following);
  robot_.position = {13.5, 5};
  finds(plan::PlanStatus::found, {{13.5, 5}, {14, 5}}, 0.1);
  EXPECT_EQ(status().state, Guidance::State::arrived);
}

TEST_F(Guided, makes_room_on_for_20_s_where_obstacles_are_lost) {
  retreat({{2, 5}, {2, 7}});
  has_obstacles_ = false;
  finds(plan::PlanStatus::found, straight_, 19.5);
  ASSERT_TRUE(navigator_.obstacles_lost());
  EXPECT_EQ(status().state, Guidance::State::make_room);
  EXPECT_EQ(status().blocked_by, class_of(7));
  EXPECT_EQ(status().detail, "no fresh obstacles");
  finds(plan::PlanStatus::found, straight_, 3.0);
  EXPECT_EQ(status().state, Guidance::State::following);
}

TEST_F(Guided, leaves_a_retreat_for_a_map_that_closes_it_where_obstacles_are_lost) {
  retreat({{2, 5}, {2, 7}});
  has_obstacles_ = false;
  finds(plan::PlanStatus::found, straight_, 2.0);
  for (int map = 0; map < 5; ++map) {
    navigator_.set_map(message_of(world_));
    finds(plan::PlanStatus::found, straight_, 1.0);
    ASSERT_EQ(status().state, Guidance::State::make_room) << map;
  }
  world_.box(1, 6, 0, 3, 6.3, 1.0);
  navigator_.set_map(message_of(world_));
  finds(plan::PlanStatus::found, straight_, 1.0);
  EXPECT_EQ(navigator_.path(), straight_);
}

TEST_F(Guided, arrives_nowhere_where_something_hits_the_robot_at_the_end_of_its_retreat) {
  retreat({{2, 5}, {2, 7}});
  robot_.position = {2, 6.9};
  finds(plan::PlanStatus::retreat, {{2, 5}, {2, 7}}, 0.1);
  obstacles_ = {{9, {1.32, 2.5}, 0.3, {0, 1}}};
  finds(plan::PlanStatus::retreat, {{2, 5}, {2, 7}}, 0.3);
  EXPECT_NE(status().state, Guidance::State::arrived);
}

TEST_F(Guided, leaves_the_end_of_a_retreat_where_something_hits_it) {
  retreat({{2, 5}, {2, 7}});
  robot_.position = {2, 6.9};
  const Path along{{2, 6.9}, {14, 6.9}};
  finds(plan::PlanStatus::closed, along, 3.0);
  ASSERT_EQ(navigator_.path(), along);
  for (const double speed : {0.0, 1.0}) {
    obstacles_ = {{9, {2, 2.5}, 0.3, {0, speed}}};
    finds(plan::PlanStatus::closed, along, 0.1);
    EXPECT_EQ(status().state, speed > 0.0 ? Guidance::State::following : Guidance::State::blocked)
        << speed;
  }
}

TEST(PathFollower, measures_angles_clockwise_from_the_nose) {
  EXPECT_NEAR(clockwise({1, 0}, {0, -1}), kPi / 2, 1e-12);
  EXPECT_NEAR(clockwise({1, 0}, {0, 1}), -kPi / 2, 1e-12);
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{0, 0}, {4, 0}, {4, -4}});
  Guidance heading;
  follower.report(heading, {{0, 1}, 0.0}, {});
  EXPECT_NEAR(heading.turn_angle, kPi / 2, 1e-12);  // of the path, wherever the robot is
  EXPECT_NEAR(heading.waypoint_angle, std::atan2(1, 4), 1e-12);
  EXPECT_NEAR(heading.path_offset, 1.0, 1e-12);
  EXPECT_NEAR(heading.goal_distance, std::hypot(4, 1) + 4, 1e-12);
}

TEST(PathFollower, tells_the_next_turn_beyond_bends_and_close_corners_as_one) {
  PathFollowerConfig config;
  const auto at_start_of = [&config](const Path& path) {
    PathFollower follower(config);
    follower.follow(path);
    Guidance heading;
    follower.report(heading, {{path[0].x, path[0].y}, 0.0}, {});
    return heading;
  };
  const Path bend{{0, 0}, {4, 0}, {8, 1}, {8, 5}};  // by 14 degrees, then by 76
  Guidance heading = at_start_of(bend);
  EXPECT_EQ(heading.waypoint, Eigen::Vector2d(8, 1));
  EXPECT_NEAR(heading.turn_angle, -std::atan2(4, 1), 1e-12);
  EXPECT_NEAR(heading.steer_angle, 0.0, 1e-12);                   // and is led along the path
  heading = at_start_of({{0, 0}, {4, 0}, {4.5, 0.5}, {4.5, 5}});  // two by 45 degrees
  EXPECT_EQ(heading.waypoint, Eigen::Vector2d(4, 0));
  EXPECT_NEAR(heading.turn_angle, -kPi / 2, 1e-12);
  heading = at_start_of({{0, 0}, {4, 0}, {8, 0.5}});
  EXPECT_TRUE(heading.waypoint_is_goal);
  EXPECT_EQ(heading.turn_angle, 0.0);
  config.one_turn = 0.0;
  heading = at_start_of(bend);
  EXPECT_EQ(heading.waypoint, Eigen::Vector2d(4, 0));
  EXPECT_NEAR(heading.turn_angle, -std::atan2(1, 4), 1e-12);
}

TEST(PathFollower, steers_to_the_path_ahead_so_that_a_drift_shows_early) {
  plan::NavMesh mesh = mesh_of(SmallWorld().room(24, 12));
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{2, 2}, {22, 2}, {22, 7}});
  Guidance heading;
  const auto steer = [&](double x, double y) {
    follower.report(heading, {{x, y}, 0.0}, *mesh.space().floor);
    return heading.steer_angle;
  };
  EXPECT_NEAR(steer(7, 2), 0.0, 1e-12);
  EXPECT_NEAR(steer(7, 2.5), std::atan2(0.5, 3.0), 1e-12);
  EXPECT_NEAR(heading.waypoint_angle, std::atan2(0.5, 15.0), 1e-12);
  EXPECT_NEAR(steer(20, 2.5), std::atan2(0.5, 2.0), 1e-12);  // not past the way-point
  EXPECT_NEAR(steer(7, 6), std::atan2(4, 15.0), 1e-12);      // far off: to the way-point
}

TEST(PathFollower, steers_clear_of_a_corner_beside_the_path) {
  // its corner juts out to the left of the path
  plan::NavMesh mesh = mesh_of(SmallWorld().room(12, 6).box(4, 2.5, 0, 12, 6, 1.0));
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{1, 1.8}, {11, 1.8}});
  const Point robot{3.6, 2.3};  // it drifted to the left, and is about to hit that corner
  Guidance heading;
  follower.report(heading, {{robot.x, robot.y}, 0.0}, *mesh.space().floor);
  const Point to{std::cos(heading.steer_angle), -std::sin(heading.steer_angle)};
  EXPECT_FALSE(mesh.space().segment_clear(robot, robot + 1.0 * Point{1.0, -0.5 / 3.0}, 0.34));
  EXPECT_TRUE(mesh.space().segment_clear(robot, robot + 0.6 * to, 0.34));
}

Point next_of(const PathFollower& follower) { return follower.remaining({})[1]; }

TEST(PathFollower, keeps_a_corner_that_would_be_cut_through_a_shelf) {
  plan::NavMesh mesh = mesh_of(SmallWorld().room(8, 8).box(2, 2, 0, 4, 6, 1.0));
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{1.2, 1.0}, {1.2, 6.6}, {4.6, 6.6}, {4.6, 1.0}});
  follower.advance({1.2, 5.7}, mesh.space());
  EXPECT_EQ(next_of(follower), (Point{1.2, 6.6}));  // within 1 m, but round the corner
  follower.advance({1.2, 6.5}, mesh.space());
  EXPECT_EQ(next_of(follower), (Point{4.6, 6.6}));
}

TEST(PathFollower, passes_a_corner_whose_next_leg_has_no_more_room_than_the_robot_needs) {
  plan::NavMesh mesh = mesh_of(SmallWorld().room(8, 8).box(2, 2, 0, 4, 6, 1.0));
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{1.0, 1.0}, {1.0, 6.36}, {4.4, 6.36}, {4.4, 1.0}});
  follower.advance({1.1, 6.4}, mesh.space());
  EXPECT_EQ(next_of(follower), (Point{4.4, 6.36}));
}

TEST(PathFollower, passes_a_corner_though_something_moving_stands_in_the_next_leg) {
  plan::NavMesh mesh = mesh_of(SmallWorld().room(8, 8));
  mesh.carve({{1, {4, 6}, 0.5, {}}});
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{1, 1}, {1, 6}, {7, 6}});
  follower.advance({1.0, 5.2}, mesh.space());
  EXPECT_EQ(next_of(follower), (Point{1, 6}));
  follower.advance({1.1, 5.8}, mesh.space());
  EXPECT_EQ(next_of(follower), (Point{7, 6}));
}

TEST(PathFollower, does_not_arrive_through_a_wall) {
  plan::NavMesh mesh = mesh_of(SmallWorld().room(8, 8).box(4, 0, 0, 4.05, 6, 1.0));
  PathFollower follower{PathFollowerConfig{}};
  follower.follow({{3.58, 2}, {4, 7}, {4.47, 2}});
  EXPECT_FALSE(follower.arrived({3.58, 2}, mesh.space()));
  EXPECT_TRUE(follower.arrived({4.47, 2.8}, mesh.space()));
}

}  // namespace
}  // namespace navvi_nav::guide
