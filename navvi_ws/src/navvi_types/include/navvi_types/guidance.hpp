#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "navvi_types/thing.hpp"

namespace navvi_types {

/// Where the guide path leads from here. Angles: rad, clockwise seen from above, 0 is straight
/// ahead, [-pi, pi].
struct Guidance {
  enum class State : std::uint8_t {
    no_goal,
    following,     ///< what follows `goal` is valid
    arrived,       ///< until the next goal
    goal_refused,  ///< see refusal
    no_route,      ///< by the map nothing joins the robot and the goal, which stays for now
    off_mesh,      ///< the robot stands where by the map no path can begin
    no_map,        ///< no usable map yet
    pose_stale,    ///< no fresh pose of the robot
    map_stale,     ///< the map is older than allowed
    blocked,       ///< a moving thing closes the path: wait; as following otherwise
    make_room,     ///< as following, but the path leads aside: something waits for the robot
  };
  enum class Refusal : std::uint8_t {
    none,
    not_finite,
    unknown_frame,
    inside_obstacle,  ///< within the robot's radius of something in the map
    off_the_map,      ///< beyond it
    unreachable,      ///< on the floor, but no floor joins it with the robot
    not_seen,         ///< nothing is known of it, or of what is within the robot's radius
  };
  enum class Replan : std::uint8_t {
    none,
    new_goal,
    path_carved,  ///< a moved obstacle's hole cut the path
    too_slow,
    period,
    waypoint_blocked,
    obstacle_near,  ///< a new obstacle came near the robot
    map_changed,
  };

  std::int64_t stamp = 0;  ///< ns, ROS time
  std::uint32_t seq = 0;   ///< no gaps
  State state = State::no_goal;
  Refusal refusal = Refusal::none;
  Replan replan_reason = Replan::none;   ///< of the last plan
  std::uint32_t plans = 0;               ///< so far
  double plan_time = 0.0;                ///< s, of the last plan, wall clock
  std::uint32_t reroutes = 0;            ///< of this goal
  Replan reroute_reason = Replan::none;  ///< of the last of them
  std::optional<double> mesh_age;        ///< s, >= 0
  std::optional<double> map_age;         ///< s, >= 0

  std::optional<ThingClass> blocked_by;     ///< while blocked or make_room
  double blocked_distance = 0.0;            ///< m, along the path to where it does, >= 0
  std::optional<double> blocked_for = 0.0;  ///< s, until it has cleared; nullopt: unknown

  Eigen::Vector2d goal = Eigen::Vector2d::Zero();      ///< m, in map
  Eigen::Vector2d waypoint = Eigen::Vector2d::Zero();  ///< m, in map: the next corner, or the goal
  double floor = 0.0;                                  ///< m, height of the floor in map
  bool ends_short = false;  ///< the goal is not seen yet: the path ends where the map does
  bool waypoint_is_goal = false;
  double waypoint_distance = 0.0;  ///< m, straight line
  double waypoint_angle = 0.0;     ///< from the robot's heading to the way-point
  double steer_angle = 0.0;        ///< where to steer: likewise, to the path a little ahead
  double turn_angle = 0.0;         ///< change of course at the way-point; 0 at the goal
  double goal_distance = 0.0;      ///< m, to the end of the path; if that is aside, on to the goal
  double eta = 0.0;                ///< s, for what is left, >= 0
  double shortest_length = 0.0;    ///< m, of the shortest path when this one was planned
  double path_offset = 0.0;        ///< m, from the robot to the nearest point of the path
  std::string detail;              ///< a sentence for the log; never spoken

  /// There is a path: the fields from `goal` on are valid.
  [[nodiscard]] bool leads() const { return is_followed() || state == State::blocked; }
  /// There is one, and it is to be followed now.
  [[nodiscard]] bool is_followed() const {
    return state == State::following || state == State::make_room;
  }
  /// There is one that does not lead aside.
  [[nodiscard]] bool leads_to_goal() const { return leads() && state != State::make_room; }
};

}  // namespace navvi_types
