#include "look/skyline.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_rviz::look {
namespace {

Eigen::Vector3d vector(const geometry_msgs::Point& at) { return {at.x, at.y, at.z}; }

Eigen::Isometry3d isometry(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
  if (turn.norm() < 1e-9) turn.setIdentity();  // as RViz takes one that was left at zero
  return Eigen::Translation3d(vector(pose.position)) * turn.normalized();
}

constexpr double kCell = 0.2;    // m
constexpr double kLowest = 0.5;  // m; what is lower hides nothing

int cell(double x) { return static_cast<int>(std::floor(x / kCell)); }

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

Skyline::Skyline(const visualization_msgs::MarkerArray& scene) {
  for (const visualization_msgs::Marker& marker : scene.markers)
    if (marker.ns != "floor")
      for (const Eigen::AlignedBox3d& solid : solids(marker)) raise(solid.min(), solid.max());
}

void Skyline::raise(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  if (high.z() < kLowest) return;
  for (int x = cell(low.x()); x <= cell(high.x()); ++x)
    for (int y = cell(low.y()); y <= cell(high.y()); ++y) {
      double& height = heights_[{x, y}];
      height = std::max(height, high.z());
    }
}

double Skyline::slope_over(const Eigen::Vector3d& place, const Eigen::Vector2d& back,
                           double reach) const {
  double steepest = 0.0;
  for (double away = 0.5 * kCell; away < reach; away += 0.5 * kCell) {
    const Eigen::Vector2d at = place.head<2>() + away * back;
    const auto found = heights_.find({cell(at.x()), cell(at.y())});
    if (found != heights_.end()) steepest = std::max(steepest, (found->second - place.z()) / away);
  }
  return steepest;
}

}  // namespace navvi_rviz::look
