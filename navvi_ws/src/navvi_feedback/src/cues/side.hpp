#pragma once

#include <Eigen/Core>
#include <cmath>

namespace navvi_feedback::cues {

/// The quarter round the robot, each 90 degrees wide and centred on its axis.
enum class Side { ahead, left, behind, right };

/// \param point  m, in base_link (x forward, y left). The robot's own centre counts as ahead.
[[nodiscard]] inline Side side_of(const Eigen::Vector2d& point) {
  if (std::abs(point.y()) > std::abs(point.x())) return point.y() > 0.0 ? Side::left : Side::right;
  return point.x() >= 0.0 ? Side::ahead : Side::behind;
}

}  // namespace navvi_feedback::cues
