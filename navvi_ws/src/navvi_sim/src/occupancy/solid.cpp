#include "occupancy/solid.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_sim::occupancy {
namespace {

// A surface that lies on the border of two cells belongs to both: a cell is grown by more than the
// places of corners and cells within WorldLimits are rounded by, and the products of the separating
// axes are allowed their own rounding, a share of the lengths that are multiplied.
constexpr double kGrown = 1e-9;  // m
constexpr double kRounding = 1e-14;

/// At least the length of `v`, and no more than 1.8 times as much.
double length_of(const Eigen::Vector3d& v) { return v.cwiseAbs().sum(); }

/// Distances from a point to the nearest and the farthest point of a square or cube around
/// `centre`, along one axis.
double nearest(double centre, double half) { return std::max(0.0, std::abs(centre) - half); }
double farthest(double centre, double half) { return std::abs(centre) + half; }

template <typename Body>
Octants one_by_one(const Body& body, const Cell& cell, double shrink) {
  Octants all{0U, 0U};
  for (unsigned i = 0; i < 8; ++i) {
    Cell eighth = octant(cell, i);
    eighth.half -= shrink;
    const Overlap part = body.overlap(eighth);
    if (part != Overlap::none) all.touched |= 1U << i;
    if (part == Overlap::full) all.full |= 1U << i;
  }
  return all;
}

}  // namespace

TurnedBox::TurnedBox(const Eigen::Vector3d& size, const Eigen::Isometry3d& pose) {
  for (int axis = 0; axis < 3; ++axis) add_axis(pose.linear().col(axis), size / 2.0, pose);
  for (int axis = 0; axis < 3; ++axis) {
    add_axis(Eigen::Vector3d::Unit(axis), size / 2.0, pose);
    for (int other = 0; other < 3; ++other)
      add_axis(Eigen::Vector3d::Unit(axis).cross(pose.linear().col(other)), size / 2.0, pose);
  }
}

void TurnedBox::add_axis(const Eigen::Vector3d& direction, const Eigen::Vector3d& half,
                         const Eigen::Isometry3d& pose) {
  const double norm = direction.norm();
  if (!(norm > 1e-9)) return;  // of parallel edges: separates nothing
  const Eigen::Vector3d unit = direction / norm;
  const double centre = unit.dot(pose.translation());
  const double reach = (pose.linear().transpose() * unit).cwiseAbs().dot(half);
  axes_.push_back({unit, centre - reach, centre + reach, unit.cwiseAbs().sum()});
}

Overlap TurnedBox::overlap(const Cell& cell) const {
  bool full = true;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    const double centre = axis.direction.dot(cell.centre);
    const double reach = axis.cell_reach * cell.half;
    if (centre - reach > axis.max || centre + reach < axis.min) return Overlap::none;
    if (i < 3 && (centre - reach < axis.min || centre + reach > axis.max)) full = false;
  }
  return full ? Overlap::full : Overlap::partial;
}

Overlap Triangle::overlap(const Cell& cell) const {
  const double half = cell.half + kGrown;
  std::array<Eigen::Vector3d, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = corners[i] - cell.centre;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::min({v[0][axis], v[1][axis], v[2][axis]}) > half) return Overlap::none;
    if (std::max({v[0][axis], v[1][axis], v[2][axis]}) < -half) return Overlap::none;
  }
  const std::array<Eigen::Vector3d, 3> edges{v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const double away = std::max({length_of(v[0]), length_of(v[1]), length_of(v[2])});
  // Apart along `axis`, which is the product of edges of that length? An axis of length 0 separates
  // nothing.
  const auto apart = [&](const Eigen::Vector3d& axis, double length) {
    const double a = axis.dot(v[0]);
    const double b = axis.dot(v[1]);
    const double c = axis.dot(v[2]);
    const double reach = axis.cwiseAbs().sum() * half + kRounding * length * away;
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  if (apart(edges[0].cross(edges[1]), length_of(edges[0]) * length_of(edges[1])))
    return Overlap::none;
  for (const Eigen::Vector3d& edge : edges)
    for (int axis = 0; axis < 3; ++axis)
      if (apart(Eigen::Vector3d::Unit(axis).cross(edge), length_of(edge))) return Overlap::none;
  return Overlap::partial;
}

Octants octants(const Solid& solid, const Cell& cell, double shrink) {
  if (const auto* box = std::get_if<TurnedBox>(&solid)) return one_by_one(*box, cell, shrink);
  if (const auto* upright = std::get_if<SolidCylinder>(&solid))
    return one_by_one(*upright, cell, shrink);
  return one_by_one(std::get<SolidSphere>(solid), cell, shrink);
}

Octants octants(const Triangle& triangle, const Cell& cell) {
  return one_by_one(triangle, cell, 0.0);
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
  const Eigen::Vector2d near(nearest(centre.x(), half), nearest(centre.y(), half));
  if (near.norm() > cylinder_.radius) return Overlap::none;
  const Eigen::Vector2d far(farthest(centre.x(), half), farthest(centre.y(), half));
  const bool full = farthest(centre.z(), half) <= reach && far.norm() <= cylinder_.radius;
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

}  // namespace navvi_sim::occupancy
