#include "look/solids.hpp"

namespace navvi_rviz::look {
namespace {

Eigen::Vector3d vector(const geometry_msgs::Point& at) { return {at.x, at.y, at.z}; }

Eigen::Isometry3d isometry(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
  if (turn.norm() < 1e-9) turn.setIdentity();  // as RViz takes one that was left at zero
  return Eigen::Translation3d(vector(pose.position)) * turn.normalized();
}

}  // namespace

std::vector<Eigen::AlignedBox3d> solids(const visualization_msgs::Marker& marker) {
  using visualization_msgs::Marker;
  std::vector<Eigen::AlignedBox3d> found;
  if (marker.action != Marker::ADD) return found;
  const Eigen::Vector3d half =
      0.5 * Eigen::Vector3d(marker.scale.x, marker.scale.y, marker.scale.z);
  switch (marker.type) {
    case Marker::CUBE:
    case Marker::CYLINDER:
    case Marker::SPHERE:
    case Marker::MESH_RESOURCE:
      found.emplace_back(-half, half);
      break;
    case Marker::CUBE_LIST:
      for (const auto& point : marker.points)
        found.emplace_back(vector(point) - half, vector(point) + half);
      break;
    case Marker::TRIANGLE_LIST:
      for (std::size_t i = 0; i + 3 <= marker.points.size(); i += 3) {
        Eigen::AlignedBox3d box;
        for (std::size_t k = i; k < i + 3; ++k) box.extend(vector(marker.points[k]));
        found.push_back(box);
      }
      break;
    case Marker::LINE_STRIP:
      if (!marker.points.empty()) found.emplace_back();
      for (const auto& point : marker.points) found.back().extend(vector(point));
      break;
    default:
      break;
  }
  const Eigen::Isometry3d pose = isometry(marker.pose);
  for (Eigen::AlignedBox3d& box : found) box = box.transformed(pose);
  return found;
}

}  // namespace navvi_rviz::look
