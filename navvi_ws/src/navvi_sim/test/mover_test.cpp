#include "navvi_sim/mover.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_sim {
namespace {

const Disc kFar{{1000.0, 1000.0}, 0.35};

Route through(const std::vector<Eigen::Vector2d>& corners, double speed = 1.0, double pause = 0.0) {
  Route route;
  for (const Eigen::Vector2d& corner : corners) route.waypoints.push_back({corner, pause});
  route.speed = speed;
  return route;
}

Thing forklift(const Eigen::Vector2d& at, double yaw, const Route& route) {
  Thing thing;
  thing.name = "forklift";
  thing.thing_class = ThingClass::forklift;
  thing.pose.translate(Eigen::Vector3d(at.x(), at.y(), 0.0));
  thing.pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  thing.shapes.push_back(
      {Box{{2.0, 1.0, 2.0}}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 1.0))});
  thing.route = route;
  return thing;
}

Mover make(const Thing& thing, bool yield = true) {
  MoversConfig config;
  config.yield = yield;
  return Mover(0, thing, config, 1);
}

void run(Mover& mover, double seconds, const Mover::Surroundings& around = {kFar, {}, {}, false}) {
  for (int i = 0; i < static_cast<int>(seconds * 100.0 + 0.5); ++i) mover.step(around, 0.01);
}

TEST(Footprint, is_measured_about_the_origin) {
  const Footprint print = footprint_of(forklift({3, 4}, 1.0, through({{0, 0}, {1, 0}})),
                                       Eigen::Quaterniond::Identity());
  EXPECT_NEAR(print.front, 1.5, 1e-12);
  EXPECT_NEAR(print.back, 0.5, 1e-12);
  EXPECT_NEAR(print.side, 0.5, 1e-12);
  EXPECT_NEAR(print.radius, std::hypot(1.5, 0.5), 1e-12);
  EXPECT_NEAR(print.top, 2.0, 1e-12);
}

TEST(Mover, begins_with_the_way_point_after_the_one_it_stands_on) {
  const Route route = through({{0, 0}, {5, 0}, {5, 5}});
  EXPECT_EQ(make(forklift({5, 0}, 0, route)).target(), 2u);
  EXPECT_EQ(make(forklift({5, 5}, 0, route)).target(), 0u);
  EXPECT_EQ(make(forklift({2, 0}, 0, route)).target(), 1u);
  EXPECT_EQ(make(forklift({9, 9}, 0, route)).target(), 0u);
}

TEST(Mover, turns_no_faster_and_drives_no_faster_than_it_may) {
  Mover mover = make(forklift({0, 0}, 0, through({{0, 0}, {4, 0}, {4, 3}}, 1.2, 0.3)));
  double yaw = mover.yaw(), speed = 0.0;
  for (int i = 0; i < 6000; ++i) {
    mover.step({kFar, {}, {}, false}, 0.01);
    EXPECT_LE(std::abs(std::remainder(mover.yaw() - yaw, 2 * 3.14159265358979)), 0.01 + 2e-3);
    EXPECT_LE(mover.speed() - speed, 0.8 * 0.01 + 1e-12);
    EXPECT_LE(mover.speed(), 1.2);
    yaw = mover.yaw();
    speed = mover.speed();
  }
}

TEST(Mover, waits_for_the_robot_ahead_as_long_as_it_stands_there_and_no_longer) {
  Mover mover = make(forklift({0, 0}, 0, through({{0, 0}, {10, 0}})));
  run(mover, 60.0, {{{6.0, 0.0}, 0.35}, {}, {}, false});
  EXPECT_EQ(mover.speed(), 0.0);
  EXPECT_LT(mover.position().x() + 1.5, 6.0 - 0.35 - 0.2);
  EXPECT_EQ(mover.target(), 1u) << "it does not turn back for the robot";
  run(mover, 3.0);
  EXPECT_GT(mover.position().x(), 5.0);
}

TEST(Mover, passes_the_robot_that_stands_beside_its_way_or_behind) {
  for (const Eigen::Vector2d& robot : {Eigen::Vector2d(5.0, 1.0), Eigen::Vector2d(-1.0, 0.0)}) {
    Mover mover = make(forklift({0, 0}, 0, through({{0, 0}, {10, 0}}, 1.0, 60.0)));
    run(mover, 14.0, {{robot, 0.35}, {}, {}, false});
    EXPECT_NEAR(mover.position().x(), 10.0, 1e-9);
  }
}

TEST(Mover, does_not_swing_its_tail_into_the_robot) {
  Mover mover = make(forklift({0, 0}, 0, through({{0, 0}, {0, 5}})));
  run(mover, 5.0, {{{0.9, 1.2}, 0.35}, {}, {}, false});
  EXPECT_EQ(mover.yaw(), 0.0);
  run(mover, 5.0);
  EXPECT_NEAR(mover.yaw(), 1.5707963, 1e-6);
}

TEST(Mover, stops_dead_where_it_would_crush_the_robot) {
  Mover mover = make(forklift({0, 0}, 0, through({{0, 0}, {10, 0}})), false);
  run(mover, 3.0);
  const Eigen::Vector2d before = mover.position();
  run(mover, 1.0, {{{3.0, 0.0}, 0.35}, {}, {}, true});
  EXPECT_EQ(mover.position(), before);
  EXPECT_EQ(mover.speed(), 0.0);
}

TEST(Mover, keeps_the_speed_and_the_pause_of_each_way_point) {
  Route route = through({{0, 0}, {10, 0}, {20, 0}});
  route.waypoints[1].pause = 5.0;
  route.waypoints[2].speed = 0.5;
  Mover mover = make(forklift({0, 0}, 0, route));
  run(mover, 5.0);
  EXPECT_NEAR(mover.speed(), 1.0, 1e-9);
  run(mover, 9.0);
  EXPECT_NEAR(mover.position().x(), 10.0, 1e-9);
  EXPECT_EQ(mover.speed(), 0.0);
  run(mover, 10.0);
  EXPECT_NEAR(mover.speed(), 0.5, 1e-9);
}

TEST(Mover, ends_at_the_last_way_point_of_a_route_without_loop) {
  Route route = through({{0, 0}, {3, 0}});
  route.loop = false;
  Mover mover = make(forklift({0, 0}, 0, route));
  run(mover, 60.0);
  EXPECT_EQ(mover.position(), Eigen::Vector2d(3, 0));
  EXPECT_EQ(mover.speed(), 0.0);
}

TEST(Mover, stands_still_before_each_round_for_as_long_as_the_delay) {
  Route route = through({{0, 0}, {1, 0}});
  route.delay = 20.0;
  Mover mover = make(forklift({0, 0}, 0, route));
  int left = 0;
  bool at_home = true;
  for (int i = 0; i < 7000; ++i) {
    mover.step({kFar, {}, {}, false}, 0.01);
    if (i < 1990) {
      EXPECT_EQ(mover.position(), Eigen::Vector2d(0, 0));
    }
    const bool now = mover.position().norm() < 1e-9;
    left += at_home && !now;
    at_home = now;
  }
  EXPECT_EQ(left, 2);
}

TEST(Mover, does_not_stop_for_the_robot_where_its_route_does_not_yield) {
  Route route = through({{0, 0}, {10, 0}});
  route.yields = false;
  Mover mover = make(forklift({0, 0}, 0, route));
  run(mover, 5.0, {{{6.0, 0.0}, 0.35}, {}, {}, false});
  EXPECT_GT(mover.speed(), 0.9);
}

}  // namespace
}  // namespace navvi_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
