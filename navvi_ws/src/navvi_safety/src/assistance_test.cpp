#include "navvi_safety/assistance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace navvi_safety {
namespace {

using navvi_types::kBrakes;
using navvi_types::NearThing;
using navvi_types::Pose2;
using navvi_types::ThingClass;
using navvi_types::Velocity;
using Does = Assistance::Does;

constexpr double kRobot = 0.35;  // m, its radius
constexpr double kStep = 0.01;   // s
constexpr double kBegin = 100.0;  // s of ROS time

/// What a round robot sees of a point, m, that has a size.
NearThing point_at(const Eigen::Vector2d& point, double radius, const Pose2& robot, bool moving) {
  NearThing thing{moving ? ThingClass::worker : ThingClass::box, 1};
  const Eigen::Vector2d seen = robot.to_local(point);
  thing.nearest = seen * (1.0 - radius / seen.norm());
  thing.gap = thing.nearest.norm() - kRobot;
  thing.moving = moving;
  return thing;
}

/// Of a wall along x at a height y, m.
NearThing wall_at(double y, const Pose2& robot) {
  NearThing thing{ThingClass::wall, 2};
  thing.nearest = robot.to_local({robot.position.x(), y});
  thing.gap = thing.nearest.norm() - kRobot;
  return thing;
}

struct Drive {
  Pose2 robot;
  double least_gap = 10.0;   ///< m
  Does did = Does::nothing;  ///< last
  double fastest = 0.0;      ///< m/s, over what was wanted
  double roughest = 0.0;     ///< m/s, the most that the speed changed by in a step
  double turned = 0.0;       ///< rad/s, the most beside what was wanted
  int sides = 0;             ///< changes between left and right
};

using Near = std::function<std::vector<NearThing>(const Pose2&, double)>;

/// Drives for a time, as the brakes allow. \param yaw  rad, at the start \param every  steps
/// between two looks at what is near
Drive drive(const char* mode, const Velocity& wanted, double seconds, const Near& near,
            double yaw = 0.0, int every = 5) {
  Assistance assistance(mode);
  Drive result;
  result.robot.yaw = yaw;
  double speed = wanted.linear, before = wanted.linear, side = 0.0;
  for (int i = 0; i * kStep < seconds; ++i) {
    const auto things = near(result.robot, i * kStep);
    for (const NearThing& thing : things)
      result.least_gap = std::min(result.least_gap, thing.gap);
    if (i % every == 0) assistance.see(things, kBegin + i * kStep);
    const Velocity driven = assistance.assist(wanted, kBegin + i * kStep);
    if (assistance.does() != Does::nothing) result.did = assistance.does();
    result.fastest = std::max(result.fastest, std::abs(driven.linear) - std::abs(wanted.linear));
    result.roughest = std::max(result.roughest, std::abs(driven.linear - before));
    before = driven.linear;
    const double turn = driven.angular - wanted.angular;
    result.turned = std::max(result.turned, std::abs(turn));
    if (turn * side < 0.0) ++result.sides;
    if (turn != 0.0) side = turn;
    speed += std::clamp(driven.linear - speed, -kBrakes * kStep, kBrakes * kStep);
    result.robot.position +=
        speed * kStep * Eigen::Vector2d(std::cos(result.robot.yaw), std::sin(result.robot.yaw));
    result.robot.yaw += driven.angular * kStep;
  }
  return result;
}

auto box_at(const Eigen::Vector2d& point) {
  return [=](const Pose2& robot, double) {
    return std::vector<NearThing>{point_at(point, 0.3, robot, false)};
  };
}

TEST(Assistance, leaves_the_command_alone_unless_it_is_wanted) {
  const Drive off = drive("off", {0.9, 0.0}, 2.0, box_at({1.2, 0.0}));
  EXPECT_NEAR(off.robot.position.x(), 1.8, 1e-9);
  EXPECT_EQ(off.did, Does::nothing);
}

TEST(Assistance, stops_steadily_before_a_thing_from_any_speed) {
  for (const double speed : {0.2, 0.5, 0.9, 1.5, -0.5}) {
    for (const double y : {0.0, 0.6}) {
      for (const int every : {5, 45}) {
        const Drive stops = drive("stop", {speed, 0.0}, 20.0,
                                  box_at({std::copysign(3.0, speed), y}), 0.0, every);
        EXPECT_GT(stops.least_gap, 0.02) << speed;
        EXPECT_LT(stops.least_gap, 0.25) << speed;
        EXPECT_LT(stops.roughest, 0.12) << speed << " " << y << " " << every;
        EXPECT_EQ(stops.did, Does::slows) << speed;
        EXPECT_NEAR(stops.robot.yaw, 0.0, 1e-9) << "it does not steer";
      }
    }
  }
}

TEST(Assistance, steers_round_a_thing_on_the_side_that_is_nearer) {
  const Drive left = drive("steer", {0.9, 0.0}, 5.0, box_at({3.0, -0.2}));
  EXPECT_GT(left.robot.position.x(), 3.0);
  EXPECT_GT(left.robot.yaw, 0.0);
  EXPECT_GT(left.least_gap, 0.0);
  EXPECT_EQ(left.did, Does::steers_left);
  const Drive right = drive("steer", {0.9, 0.0}, 5.0, box_at({3.0, 0.2}));
  EXPECT_LT(right.robot.yaw, 0.0);
  EXPECT_GT(right.least_gap, 0.0);
  EXPECT_EQ(right.did, Does::steers_right);
  for (const double y : {-0.1, -0.05, 0.0})
    EXPECT_EQ(drive("steer", {0.9, 0.0}, 3.0, box_at({3.0, y})).sides, 0) << y;
}

TEST(Assistance, never_turns_against_the_person_nor_fast_and_never_drives_faster) {
  for (const double x : {0.9, 1.5}) {
    for (const double y : {-0.6, -0.2, 0.0, 0.2, 0.6}) {
      const Drive left = drive("steer", {0.9, 0.3}, 1.5, box_at({x, y}));
      EXPECT_GE(left.robot.yaw, 0.3 * 1.4) << x << " " << y;
      EXPECT_LE(left.turned, 0.8 + 1e-9);
      EXPECT_LE(left.fastest, 0.0);
      EXPECT_GT(left.least_gap, 0.0);
      const Drive right = drive("steer", {0.9, -0.3}, 1.5, box_at({x, -y}));
      EXPECT_NEAR(right.robot.yaw, -left.robot.yaw, 1e-6) << "the sides are alike";
      EXPECT_NEAR(right.robot.position.x(), left.robot.position.x(), 1e-6);
    }
  }
}

TEST(Assistance, leads_a_robot_that_nears_a_wall_along_it) {
  const auto wall = [](const Pose2& robot, double) {
    return std::vector<NearThing>{wall_at(-0.8, robot)};
  };
  const Drive along = drive("steer", {0.9, 0.0}, 6.0, wall, -0.4);
  EXPECT_GT(along.least_gap, 0.0);
  EXPECT_GT(along.robot.position.x(), 4.0) << "it goes on";
}

TEST(Assistance, leaves_a_person_alone_who_drives_along_a_wall_past_a_thing_or_away) {
  const auto wall = [](const Pose2& robot, double) {
    return std::vector<NearThing>{wall_at(-0.45, robot)};
  };
  const Drive along = drive("steer", {0.9, 0.0}, 3.0, wall);
  EXPECT_NEAR(along.robot.position.x(), 2.7, 0.01);
  EXPECT_EQ(along.did, Does::nothing);
  const Drive past = drive("stop", {0.9, 0.0}, 3.0, box_at({2.0, 0.8}));
  EXPECT_NEAR(past.robot.position.x(), 2.7, 0.01);
  const Drive away = drive("steer", {-0.5, 0.2}, 2.0, box_at({0.7, 0.0}));
  EXPECT_NEAR(away.robot.yaw, 0.4, 1e-9);
  EXPECT_EQ(away.did, Does::nothing);
  const Drive turns = drive("steer", {0.0, 1.0}, 2.0, box_at({0.7, 0.0}));
  EXPECT_NEAR(turns.robot.yaw, 2.0, 1e-9);
}

TEST(Assistance, stops_for_what_crosses_before_it_is_in_the_way) {
  const auto crosses = [](const Pose2& robot, double time) {
    return std::vector<NearThing>{point_at({2.0, -2.2 + time}, 0.3, robot, true)};
  };
  EXPECT_LE(drive("off", {0.9, 0.0}, 6.0, crosses).least_gap, 0.0);
  const Drive stops = drive("stop", {0.9, 0.0}, 6.0, crosses);
  EXPECT_GT(stops.least_gap, 0.1);
  EXPECT_GT(stops.robot.position.x(), 2.0) << "and goes on when it has passed";
  const auto halts = [](const Pose2& robot, double time) {
    return std::vector<NearThing>{point_at({2.0, std::min(-1.0, -2.2 + time)}, 0.3, robot, true)};
  };
  EXPECT_GT(drive("stop", {0.9, 0.0}, 3.0, halts).robot.position.x(), 1.5) << "or stands";
}

TEST(Assistance, takes_another_part_that_is_nearest_for_no_movement) {
  for (const bool moving : {true, false}) {
    const auto turns = [=](const Pose2& robot, double time) {
      const double leaps = time < 1.0 ? -2.0 : -1.2, slides = std::min(-1.0, -2.2 + time);
      return std::vector<NearThing>{point_at({2.0, moving ? leaps : slides}, 0.3, robot, moving)};
    };
    const Drive past = drive("stop", {0.9, 0.0}, 3.0, turns);
    EXPECT_NEAR(past.robot.position.x(), 2.7, 0.01) << moving;
  }
}

TEST(Assistance, begins_anew_where_time_does) {
  Assistance assistance("stop");
  for (const double begin : {100.0, 5.0}) {
    EXPECT_NEAR(assistance.assist({0.8, 0.0}, begin).linear, 0.2, 1e-9) << "nothing came yet";
    for (double time = 0.0; time < 0.3; time += 0.05)
      assistance.see({point_at({1.2, -1.2 + time}, 0.3, {}, true)}, begin + time);
    EXPECT_EQ(assistance.assist({0.8, 0.0}, begin + 0.3).linear, 0.0) << "it will be in the way";
  }
}

TEST(Assistance, tells_at_once_what_it_does_and_for_a_while) {
  Assistance assistance("stop");
  const auto does = [&](double time, bool sees) {
    if (sees) assistance.see({}, time);
    (void)assistance.assist({0.8, 0.0}, time);
    return assistance.does();
  };
  EXPECT_EQ(does(9.0, true), Does::nothing);
  EXPECT_EQ(does(9.6, false), Does::slows);
  EXPECT_EQ(does(9.8, false), Does::slows);
  EXPECT_EQ(does(10.1, true), Does::slows) << "until it can be felt";
  EXPECT_EQ(does(10.3, true), Does::nothing);
  EXPECT_EQ(does(10.9, false), Does::slows);
  EXPECT_EQ(does(1.0, true), Does::nothing) << "of another time";
}

TEST(Assistance, creeps_where_nothing_is_known_of_what_is_near) {
  Assistance assistance("stop");
  EXPECT_NEAR(assistance.assist({0.8, 0.2}, 1.0).linear, 0.2, 1e-9) << "nothing came";
  assistance.see({}, 1.0);
  EXPECT_EQ(assistance.assist({0.8, 0.2}, 1.1).linear, 0.8);
  EXPECT_NEAR(assistance.assist({0.8, 0.2}, 1.7).linear, 0.2, 1e-9) << "nothing came of late";
}

}  // namespace
}  // namespace navvi_safety
