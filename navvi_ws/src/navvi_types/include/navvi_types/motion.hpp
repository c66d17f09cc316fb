#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace navvi_types {

/// A frame on the floor, such as base_link in map.
struct Pose2 {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double yaw = 0.0;                                    ///< rad, counter-clockwise from x

  /// A point of the parent frame, as seen from here, m.
  [[nodiscard]] Eigen::Vector2d to_local(const Eigen::Vector2d& point) const {
    return Eigen::Rotation2Dd(-yaw) * (point - position);
  }
  /// A point of this frame in its parent, m.
  [[nodiscard]] Eigen::Vector2d to_parent(const Eigen::Vector2d& point) const {
    return position + Eigen::Rotation2Dd(yaw) * point;
  }
};

/// Planar velocity of base_link (REP-103).
struct Velocity {
  double linear = 0.0;   ///< m/s, forward
  double angular = 0.0;  ///< rad/s, counter-clockwise
};

/// `now` moved towards `target`, by at most `faster` where its size grows, `slower` where it falls.
/// A change of direction brakes first.
[[nodiscard]] inline double approach(double now, double target, double faster, double slower) {
  const double goal = now * target < 0.0 ? 0.0 : target;
  const double limit = std::abs(goal) > std::abs(now) ? faster : slower;
  return now + std::clamp(goal - now, -limit, limit);
}

/// nav_msgs/Odometry on the floor.
struct Odometry {
  std::int64_t stamp = 0;  ///< ns, ROS time
  Pose2 pose = {};         ///< base_link in odom
  Velocity velocity = {};
  double sideways = 0.0;  ///< m/s, left: only a push makes it other than 0
  double floor = 0.0;     ///< m, height of the floor in odom
};

/// m above the floor, of a robot with its load: what begins higher does not matter to it. The map,
/// the simulated hull, what is near and what a robot's own sensors see share this default.
inline constexpr double kHeadroom = 0.8;

/// m/s^2, by which the wheels of a robot slow down at least (doc/robot.md).
inline constexpr double kBrakes = 2.0;

/// m, beyond where a pose arrives; by odometry the goal may be so much farther.
inline constexpr double kArrivalMargin = 1.0;

/// Whether odometry contradicts an arrival: a pose alone may be a false one.
/// \param by_odometry, goal  m, in map \param range  m, within which the two agree
[[nodiscard]] inline bool arrived_elsewhere(const Eigen::Vector2d& by_odometry,
                                            const Eigen::Vector2d& goal, double range) {
  return (by_odometry - goal).norm() > range;
}

/// rad in (-pi, pi], clockwise from the nose of a robot at `robot` to `target`, m, in its frame.
[[nodiscard]] inline double clockwise_angle(const Pose2& robot, const Eigen::Vector2d& target) {
  const Eigen::Vector2d seen = robot.to_local(target);
  return -std::atan2(seen.y(), seen.x());
}

}  // namespace navvi_types
