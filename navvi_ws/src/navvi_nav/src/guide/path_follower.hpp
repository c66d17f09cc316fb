#pragma once

#include <algorithm>
#include <limits>
#include <navvi_config/field.hpp>
#include <navvi_floor/floor.hpp>
#include <navvi_types/guidance.hpp>

#include "guide/cylinders.hpp"

namespace navvi_nav::guide {

using navvi_types::Guidance;

struct PathFollowerConfig {
  double waypoint_reached = 1.0;
  double goal_reached = 1.0;
  double sight_radius = 0.4;
  double easy_radius = 0.6;
  static constexpr double kClose = 0.4;  ///< m, distance from a way-point that counts as close
  double one_turn = 1.0;
  double steer_ahead = 3.0;
  double least_ahead = 0.8;

  void describe(navvi_config::Visitor& visit);
};

/// Follows one path way-point by way-point (R-NAV-8, R-NAV-11).
class PathFollower {
 public:
  explicit PathFollower(const PathFollowerConfig& config) : config_(config) {}

  /// Starts `path` (from the robot to the goal); an empty path clears.
  void follow(const Path& path);
  [[nodiscard]] bool following() const { return path_.size() >= 2; }
  [[nodiscard]] const Path& path() const { return path_; }
  /// What is left of the path: the robot, the next way-point, and on to the goal.
  [[nodiscard]] Path remaining(Point robot) const;

  /// Passes on to the next way-point where the robot is near enough and the straight way to the
  /// one after has easy_radius of room, or sight_radius, or what the leg has, once it is `close`; a
  /// corner that it could only cut through something stays. following() must hold.
  void advance(Point robot, const map::Space& space);
  /// True if the robot is near enough to the goal and nothing stands in between.
  [[nodiscard]] bool arrived(Point robot, const map::Space& space) const;
  /// True if nothing stands on the first `within` m from the robot to the next way-point.
  /// following() must hold.
  [[nodiscard]] bool sees_next(Point robot, const map::Space& space,
                               double within = std::numeric_limits<double>::infinity()) const {
    const Point leg = path_[next_] - robot;
    return sees(robot, robot + std::min(1.0, within / std::max(norm(leg), 1e-9)) * leg, space);
  }
  /// m, from the robot to the nearest point of the path. following() must hold.
  [[nodiscard]] double offset(Point robot) const { return away(robot, path_); }
  /// True if something stands between a robot and the leg that it follows, as when a localizer
  /// corrects itself. following() must hold.
  [[nodiscard]] bool cut_off(Point robot, const map::Floor& floor) const;
  /// Fills in where the path leads, from the way-point, which is the next turn or the end, to the
  /// path's offset. following() must hold.
  void report(Guidance& out, const Pose2& robot, const map::Floor& floor) const;

 private:
  [[nodiscard]] bool sees(Point robot, Point target, const map::Space& space) const;
  [[nodiscard]] Point steer_point(Point robot, const map::Floor& floor) const;
  [[nodiscard]] bool leaves_corner(Point robot, const map::Space& space) const;
  [[nodiscard]] bool reached(Point robot, const map::Space& space) const;

  PathFollowerConfig config_;
  Path path_;
  std::size_t next_ = 0;
};

}  // namespace navvi_nav::guide
