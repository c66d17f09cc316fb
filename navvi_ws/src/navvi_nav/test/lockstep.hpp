#pragma once

#include <gtest/gtest.h>

#include "guide/navigator.hpp"
#include "small_world.hpp"

namespace navvi_nav::guide {

inline constexpr double kTick = 0.05;  // s

inline std::shared_ptr<const plan::MapMessage> message_of(SmallWorld& world) {
  return std::make_shared<const plan::MapMessage>(
      plan::MapMessage{world.bytes(), true, "OcTree", world.tree().getResolution()});
}

/// Tests tell things apart by their class: nine ids in a row have eight classes.
inline navvi_types::ThingClass class_of(std::uint32_t id) {
  return static_cast<navvi_types::ThingClass>(1 + id % 8);
}

/// A thing as the cylinder about it, and its rectangle along `yaw`.
inline MovingThing moving_thing(const Cylinder& one, double yaw = 0.0, double length = 0.0,
                                double width = 0.0) {
  return {one.id,
          class_of(one.id),
          {{one.center.x, one.center.y}, yaw},
          {one.velocity.x, one.velocity.y},
          one.radius,
          1.0,
          length,
          width};
}

/// Navigator and planner in lockstep: each request is answered within the tick.
class Lockstep : public testing::Test {
 protected:
  Lockstep() : Lockstep(16, 10) { world_.box(6, 3, 0, 9, 7, 1.0); }
  Lockstep(double width, double depth, const NavigatorConfig& config = {}) : config_(config) {
    world_.room(width, depth);
  }

  void load() {
    navigator_.set_map(message_of(world_));
    tick();
  }
  void lead(const Eigen::Vector2d& goal) {
    load();
    navigator_.set_goal(goal);
    tick(2);
  }
  void tick(int times = 1) {
    for (int i = 0; i < times; ++i) {
      if (const auto request = ask()) {
        last_ = planner_.answer(*request);
        navigator_.deliver(*last_, time_);
      }
    }
  }
  /// A tick. \returns what is asked of the planner in it
  std::optional<plan::PlanRequest> ask() {
    time_ += kTick;
    if (has_pose_)
      navigator_.set_pose({{robot_.position.x, robot_.position.y}, robot_.yaw}, height_, time_);
    if (has_odometry_) navigator_.set_velocity({speed_, 0.0});
    if (has_obstacles_) {
      std::vector<MovingThing> things = things_;
      for (const Cylinder& obstacle : obstacles_) things.push_back(moving_thing(obstacle));
      navigator_.set_obstacles(things, time_);
    }
    return navigator_.update(time_);
  }
  /// The clock is set.
  void jump(double by) {
    time_ += by;
    navigator_.reset_times(by);
  }
  /// Moves the robot to where guidance steers.
  void drive(double step) {
    const Guidance now = status();
    robot_.yaw -= now.steer_angle;
    const double length = std::min(step, now.waypoint_distance);
    robot_.position = robot_.position + length * Point{std::cos(robot_.yaw), std::sin(robot_.yaw)};
    tick();
  }
  /// One tick of a person who follows at `pace`, m/s, and stands while told to wait.
  void follow(double pace) {
    const Guidance::State state = status().state;
    const bool drives = state == Guidance::State::following || state == Guidance::State::make_room;
    speed_ = drives ? pace : 0.0;
    if (drives)
      drive(pace * kTick);
    else
      tick();
  }
  [[nodiscard]] Guidance status() const { return navigator_.guidance(time_); }

  SmallWorld world_;
  NavigatorConfig config_;
  Navigator navigator_{config_};
  plan::Planner planner_{config_.planner};
  std::optional<plan::PlanAnswer> last_;
  std::vector<Cylinder> obstacles_;
  std::vector<MovingThing> things_;  ///< besides
  struct {
    Point position{2, 5};
    double yaw = 0.0;
  } robot_;
  double height_ = 0.0;  // of the robot
  bool has_pose_ = true;
  bool has_obstacles_ = true;
  bool has_odometry_ = true;
  double speed_ = 0.5;
  double time_ = 100.0;
};

}  // namespace navvi_nav::guide
