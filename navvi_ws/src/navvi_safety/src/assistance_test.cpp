#include "navvi_safety/assistance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace navvi_safety {
namespace {

using navvi_types::NearThing;
using navvi_types::Pose2;
using navvi_types::ThingClass;
using navvi_types::Velocity;
using Does = Assistance::Does;

constexpr double kRobot = 0.35;  // m, its radius
constexpr double kStep = 0.01;   // s

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
  double least_gap = 10.0;  ///< m
  Does did = Does::nothing;  ///< last
  double fastest = 0.0;     ///< m/s, over what was wanted
};

/// Drives for a time, with what is near at 20 Hz. \param yaw  rad, at the start
Drive drive(const char* mode, const Velocity& wanted, double seconds,
            const std::function<std::vector<NearThing>(const Pose2&, double)>& near,
            double yaw = 0.0) {
  Assistance assistance(mode);
  Drive result;
  result.robot.yaw = yaw;
  for (int i = 0; i * kStep < seconds; ++i) {
    const double time = i * kStep;
    const auto things = near(result.robot, time);
    for (const NearThing& thing : things)
      result.least_gap = std::min(result.least_gap, thing.gap);
    if (i % 5 == 0) assistance.see(things, time);
    const Velocity driven = assistance.assist(wanted, time);
    if (assistance.does() != Does::nothing) result.did = assistance.does();
    result.fastest = std::max(result.fastest, std::abs(driven.linear) - std::abs(wanted.linear));
    result.robot.position += driven.linear * kStep *
                             Eigen::Vector2d(std::cos(result.robot.yaw), std::sin(result.robot.yaw));
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

TEST(Assistance, stops_before_a_thing_from_any_speed) {
  for (const double speed : {0.2, 0.5, 0.9, -0.5}) {
    const Drive stops =
        drive("stop", {speed, 0.0}, 20.0, box_at({std::copysign(3.0, speed), 0.0}));
    EXPECT_GT(stops.least_gap, 0.02) << speed;
    EXPECT_LT(stops.least_gap, 0.2) << speed;
    EXPECT_EQ(stops.did, Does::slows) << speed;
    EXPECT_NEAR(stops.robot.yaw, 0.0, 1e-9) << "it does not steer";
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
}

TEST(Assistance, never_turns_against_the_person_and_never_drives_faster) {
  for (const double turn : {0.3, -0.3}) {
    for (const double y : {-0.2, 0.0, 0.2}) {
      const Drive drives = drive("steer", {0.9, turn}, 1.5, box_at({1.5, y}));
      EXPECT_GE(drives.robot.yaw * turn, turn * turn * 1.4) << turn << " " << y;
      EXPECT_LE(drives.fastest, 0.0);
      EXPECT_GT(drives.least_gap, 0.0);
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

TEST(Assistance, leaves_a_person_who_drives_along_a_wall_or_away_alone) {
  const auto wall = [](const Pose2& robot, double) {
    return std::vector<NearThing>{wall_at(-0.45, robot)};
  };
  const Drive along = drive("steer", {0.9, 0.0}, 3.0, wall);
  EXPECT_NEAR(along.robot.position.x(), 2.7, 0.01);
  EXPECT_EQ(along.did, Does::nothing);
  const Drive away = drive("steer", {-0.5, 0.0}, 2.0, box_at({0.7, 0.0}));
  EXPECT_NEAR(away.robot.position.x(), -1.0, 0.01);
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
