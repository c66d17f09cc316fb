#include "navvi_feedback/cues/side.hpp"

#include <cmath>

namespace navvi_feedback::cues {

Side side_of(const Eigen::Vector2d& point) {
  if (std::abs(point.y()) > std::abs(point.x())) return point.y() > 0.0 ? Side::left : Side::right;
  return point.x() >= 0.0 ? Side::ahead : Side::behind;
}

}  // namespace navvi_feedback::cues
