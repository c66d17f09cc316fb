#pragma once

namespace navvi_nav::plan {

/// Why a goal is refused; values as in navvi_msgs/Guidance, like those below.
enum class Refusal {
  none,
  not_finite,
  unknown_frame,
  inside_obstacle,
  off_the_map,
  unreachable,
};

/// Why a plan was made.
enum class Reason {
  none,
  new_goal,
  path_carved,
  too_slow,
  period,
  waypoint_blocked,
  obstacle_near,
  map_changed,
};

/// What the person is told.
enum class State {
  no_goal,
  following,
  arrived,
  goal_refused,
  no_route,
  off_mesh,
  no_map,
  pose_stale,
  map_stale,
  blocked,
  make_room,
};

}  // namespace navvi_nav::plan
