#include "navvi_types/motion.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace navvi_types {

Eigen::Vector2d Pose2::to_local(const Eigen::Vector2d& point) const {
  return Eigen::Rotation2Dd(-yaw) * (point - position);
}

Eigen::Vector2d Pose2::to_parent(const Eigen::Vector2d& point) const {
  return position + Eigen::Rotation2Dd(yaw) * point;
}

double clockwise_angle(const Pose2& robot, const Eigen::Vector2d& target) {
  const Eigen::Vector2d seen = robot.to_local(target);
  return -std::atan2(seen.y(), seen.x());
}

}  // namespace navvi_types
