#pragma once

#include <Eigen/Core>
#include <cmath>
#include <navvi_types/angles.hpp>

namespace navvi_feedback::cues {

/// The quarter round the robot, each 90 degrees wide and centred on its axis.
enum class Side { ahead, left, behind, right };

/// \param point  m, in base_link (x forward, y left). The robot's own centre counts as ahead.
[[nodiscard]] inline Side side_of(const Eigen::Vector2d& point) {
  if (std::abs(point.y()) > std::abs(point.x())) return point.y() > 0.0 ? Side::left : Side::right;
  return point.x() >= 0.0 ? Side::ahead : Side::behind;
}

/// The middle of that quarter, in base_link.
[[nodiscard]] inline Eigen::Vector2d direction_of(Side side) {
  const double angle = static_cast<int>(side) * navvi_types::kPi / 2.0;
  return {std::cos(angle), std::sin(angle)};
}

/// m; half as wide as what the robot drives over, and a little.
constexpr double kHalfLane = 0.45;

/// As side_of(), but ahead is only what the robot would drive over.
[[nodiscard]] inline Side side_of_lane(const Eigen::Vector2d& point) {
  const Side side = side_of(point);
  if (side != Side::ahead || std::abs(point.y()) <= kHalfLane) return side;
  return point.y() > 0.0 ? Side::left : Side::right;
}

}  // namespace navvi_feedback::cues
