#include "look/skyline.hpp"

#include <algorithm>
#include <cmath>

#include "look/solids.hpp"

namespace navvi_rviz::look {
namespace {

constexpr double kCell = 0.2;    // m
constexpr double kLowest = 0.5;  // m; what is lower hides nothing

int cell(double x) { return static_cast<int>(std::floor(x / kCell)); }

}  // namespace

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
