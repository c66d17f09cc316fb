#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "navvi_feedback/nearby.hpp"

namespace navvi_feedback {

/// Where the guide path leads from here: navvi_msgs/Guidance without ROS, with the values of its
/// constants. Angles: rad, clockwise seen from above, 0 is straight ahead, [-pi, pi].
struct Guidance {
  enum class State : std::uint8_t {
    no_goal = 0,
    following = 1,  ///< the fields from `goal` on are valid
    arrived = 2,
    goal_refused = 3,
    no_route = 4,
    off_mesh = 5,
    no_map = 6,
    pose_stale = 7,
    map_stale = 8,
    blocked = 9,     ///< by something that moves; as following otherwise
    make_room = 10,  ///< as following, but the path leads off the way of what waits for the robot
  };
  enum class Refusal : std::uint8_t {
    not_refused = 0,
    not_finite = 1,
    unknown_frame = 2,
    inside_obstacle = 3,
    off_the_map = 4,
    unreachable = 5,
  };
  enum class Replan : std::uint8_t {
    none = 0,
    new_goal = 1,
    path_carved = 2,
    too_slow = 3,
    period = 4,
    waypoint_blocked = 5,
    obstacle_near = 6,
    map_changed = 7,
  };

  std::uint32_t seq = 0;
  State state = State::no_goal;
  Refusal refusal = Refusal::not_refused;
  Replan replan_reason = Replan::none;        ///< of the last plan
  std::uint32_t reroutes = 0;                 ///< of this goal
  Replan reroute_reason = Replan::none;       ///< of the last of them
  ThingClass blocked_by = ThingClass::other;  ///< while blocked or make_room

  Eigen::Vector2d goal = Eigen::Vector2d::Zero();      ///< m, in map
  Eigen::Vector2d waypoint = Eigen::Vector2d::Zero();  ///< m, in map: the next corner, or the goal
  bool waypoint_is_goal = false;
  double waypoint_distance = 0.0;  ///< m, straight line
  double waypoint_angle = 0.0;     ///< from the robot's heading to the way-point
  double steer_angle = 0.0;        ///< where to steer: likewise, to the path a little ahead
  double floor = 0.0;              ///< m, height of the floor in map
  double turn_angle = 0.0;         ///< change of course at the way-point; 0 at the goal
  double goal_distance = 0.0;      ///< m, along the path
  double path_offset = 0.0;        ///< m, from the robot to the nearest point of the path

  /// There is a path: the fields from `goal` on are valid.
  [[nodiscard]] bool leads() const { return is_followed() || state == State::blocked; }
  /// There is one, and it is to be followed now.
  [[nodiscard]] bool is_followed() const {
    return state == State::following || state == State::make_room;
  }
};

}  // namespace navvi_feedback
