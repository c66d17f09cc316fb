#pragma once

#include <Eigen/Core>

namespace navvi_feedback::cues {

/// The quarter round the robot, each 90 degrees wide and centred on its axis.
enum class Side { ahead, left, behind, right };

/// \param point  m, in base_link (x forward, y left). The robot's own centre counts as ahead.
[[nodiscard]] Side side_of(const Eigen::Vector2d& point);

}  // namespace navvi_feedback::cues
