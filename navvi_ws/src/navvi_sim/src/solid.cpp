#include "solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_sim {
namespace {

constexpr double kTolerance = 1e-9;  // m

/// Distances from a point to the nearest and the farthest point of a square or cube around
/// `centre`, along one axis.
double nearest(double centre, double half) { return std::max(0.0, std::abs(centre) - half); }
double farthest(double centre, double half) { return std::abs(centre) + half; }

}  // namespace

void Convex::add_axis(const Eigen::Vector3d& direction,
                      const std::vector<Eigen::Vector3d>& corners) {
  const double norm = direction.norm();
  if (!(norm > 1e-9)) return;  // of parallel edges: separates nothing
  Axis axis;
  axis.direction = direction / norm;
  axis.min = std::numeric_limits<double>::max();
  axis.max = std::numeric_limits<double>::lowest();
  for (const Eigen::Vector3d& corner : corners) {
    axis.min = std::min(axis.min, axis.direction.dot(corner));
    axis.max = std::max(axis.max, axis.direction.dot(corner));
  }
  axis.cell_reach = axis.direction.cwiseAbs().sum();
  axes_.push_back(axis);
}

Convex Convex::box(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose) {
  std::vector<Eigen::Vector3d> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        corners.push_back(pose * Eigen::Vector3d(x * size.x(), y * size.y(), z * size.z()));
  Convex convex;
  for (int axis = 0; axis < 3; ++axis) convex.add_axis(pose.linear().col(axis), corners);
  convex.faces_ = convex.axes_.size();
  const bool aligned = (pose.linear().cwiseAbs().rowwise().maxCoeff().array() > 1.0 - 1e-9).all();
  if (aligned) return convex;
  for (int axis = 0; axis < 3; ++axis) {
    convex.add_axis(Eigen::Vector3d::Unit(axis), corners);
    for (int other = 0; other < 3; ++other)
      convex.add_axis(Eigen::Vector3d::Unit(axis).cross(pose.linear().col(other)), corners);
  }
  return convex;
}

Convex Convex::triangle(const std::array<Eigen::Vector3d, 3>& corners) {
  const std::vector<Eigen::Vector3d> points(corners.begin(), corners.end());
  const std::array<Eigen::Vector3d, 3> edges{corners[1] - corners[0], corners[2] - corners[1],
                                             corners[0] - corners[2]};
  Convex convex;
  for (int axis = 0; axis < 3; ++axis) convex.add_axis(Eigen::Vector3d::Unit(axis), points);
  convex.add_axis(edges[0].cross(edges[1]), points);
  for (const Eigen::Vector3d& edge : edges)
    for (int axis = 0; axis < 3; ++axis)
      convex.add_axis(Eigen::Vector3d::Unit(axis).cross(edge), points);
  return convex;
}

Overlap Convex::overlap(const Cell& cell) const {
  bool full = faces_ > 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    const double centre = axis.direction.dot(cell.centre);
    const double reach = axis.cell_reach * cell.half;
    if (centre - reach > axis.max || centre + reach < axis.min) return Overlap::none;
    if (i < faces_ &&
        (centre - reach < axis.min - kTolerance || centre + reach > axis.max + kTolerance))
      full = false;
  }
  return full ? Overlap::full : Overlap::partial;
}

SolidCylinder::SolidCylinder(const Cylinder& cylinder, const Eigen::Isometry3d& pose)
    : cylinder_(cylinder),
      to_local_(pose.inverse()),
      upright_(std::abs(pose.linear()(2, 2)) > 1.0 - 1e-9) {
  // An upright cylinder looks the same from all sides: keep the axes of map.
  if (upright_) to_local_ = Eigen::Translation3d(-pose.translation());
}

Overlap SolidCylinder::overlap_upright(const Eigen::Vector3d& centre, double half) const {
  const double reach = cylinder_.length / 2.0;
  if (nearest(centre.z(), half) > reach) return Overlap::none;
  if (std::hypot(nearest(centre.x(), half), nearest(centre.y(), half)) > cylinder_.radius)
    return Overlap::none;
  const bool full =
      farthest(centre.z(), half) <= reach + kTolerance &&
      std::hypot(farthest(centre.x(), half), farthest(centre.y(), half)) <= cylinder_.radius;
  return full ? Overlap::full : Overlap::partial;
}

Overlap SolidCylinder::overlap(const Cell& cell) const {
  const Eigen::Vector3d centre = to_local_ * cell.centre;
  if (upright_) return overlap_upright(centre, cell.half);
  const double ball = cell.half * std::sqrt(3.0);
  const double radial = centre.head<2>().norm();
  const double along = std::abs(centre.z());
  const double reach = cylinder_.length / 2.0;
  if (radial > cylinder_.radius + ball || along > reach + ball) return Overlap::none;
  const bool full = radial + ball <= cylinder_.radius && along + ball <= reach;
  return full ? Overlap::full : Overlap::partial;
}

Overlap SolidSphere::overlap(const Cell& cell) const {
  const Eigen::Vector3d centre = cell.centre - centre_;
  Eigen::Vector3d near;
  Eigen::Vector3d far;
  for (int axis = 0; axis < 3; ++axis) {
    near[axis] = nearest(centre[axis], cell.half);
    far[axis] = farthest(centre[axis], cell.half);
  }
  if (near.norm() > radius_) return Overlap::none;
  return far.norm() <= radius_ ? Overlap::full : Overlap::partial;
}

}  // namespace navvi_sim
