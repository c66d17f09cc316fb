#include "look/skyline.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_rviz::look {
namespace {

using visualization_msgs::Marker;

constexpr double kCell = 0.2;    // m
constexpr double kLowest = 0.5;  // m; what is lower hides nothing

int cell(double x) { return static_cast<int>(std::floor(x / kCell)); }

Eigen::Vector3d vector(const geometry_msgs::Point& at) { return {at.x, at.y, at.z}; }

}  // namespace

Skyline::Skyline(const visualization_msgs::MarkerArray& scene) {
  for (const Marker& marker : scene.markers) {
    if (marker.action != Marker::ADD || marker.ns == "floor") continue;
    const Eigen::Vector3d origin = vector(marker.pose.position);
    if (marker.type == Marker::CUBE_LIST) {
      const Eigen::Vector3d half =
          0.5 * Eigen::Vector3d(marker.scale.x, marker.scale.y, marker.scale.z);
      for (const auto& point : marker.points)
        raise(origin + vector(point) - half, origin + vector(point) + half);
    }
    if (marker.type != Marker::TRIANGLE_LIST) continue;
    for (std::size_t i = 0; i + 3 <= marker.points.size(); i += 3) {
      const Eigen::Vector3d a = vector(marker.points[i]), b = vector(marker.points[i + 1]),
                            c = vector(marker.points[i + 2]);
      raise(origin + a.cwiseMin(b).cwiseMin(c), origin + a.cwiseMax(b).cwiseMax(c));
    }
  }
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
