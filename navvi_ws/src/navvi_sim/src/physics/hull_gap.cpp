#include "physics/hull_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace navvi_sim::physics {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kUpright = 1.0 - 1e-12;  // of an axis's z
constexpr int kSides = 128;               // of the prism for a tilted cylinder

/// A height of both.
double shared_height(const Hull& hull, double bottom, double top) {
  return 0.5 * (std::max(bottom, hull.bottom) + std::min(top, hull.top));
}

/// The axis of the three that is vertical; -1 if none is.
int vertical_axis(const Eigen::Isometry3d& pose) {
  for (int axis = 2; axis >= 0; --axis)
    if (std::abs(pose.linear()(2, axis)) > kUpright) return axis;
  return -1;
}

/// A rectangle that stands upright over heights.
Gap gap_to_upright(const Hull& hull, const Eigen::Vector3d& half, const Eigen::Isometry3d& pose,
                   int up) {
  const int ahead = (up + 1) % 3, aside = (up + 2) % 3;
  const Eigen::Vector2d away = hull.centre - pose.translation().head<2>();
  const Eigen::Vector2d x = pose.linear().col(ahead).head<2>();
  const Eigen::Vector2d y = pose.linear().col(aside).head<2>();
  const Eigen::Vector2d local(x.dot(away), y.dot(away));
  const Eigen::Vector2d reach(half[ahead], half[aside]);
  Eigen::Vector2d nearest = local.cwiseMax(-reach).cwiseMin(reach);
  double beside = (local - nearest).norm();
  if (nearest == local) {
    const Eigen::Vector2d depth = reach - local.cwiseAbs();
    const int axis = depth.x() < depth.y() ? 0 : 1;
    beside = -depth[axis];
    nearest[axis] = local[axis] < 0.0 ? -reach[axis] : reach[axis];
  }
  const double z = pose.translation().z();
  const Eigen::Vector2d at = pose.translation().head<2>() + nearest.x() * x + nearest.y() * y;
  return {beside - hull.radius, {at.x(), at.y(), shared_height(hull, z - half[up], z + half[up])}};
}

/// The point of the segment nearest to `point`, both seen from above.
Eigen::Vector3d nearest_on(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = (b - a).head<2>();
  const double length = along.squaredNorm();
  const double share =
      length > 0.0 ? std::clamp(along.dot(point - a.head<2>()) / length, 0.0, 1.0) : 0.0;
  return a + share * (b - a);
}

/// A triangle cut by planes of equal height: a few corners.
struct Slice {
  std::array<Eigen::Vector3d, 8> corners;
  std::size_t count = 0;

  void add(const Eigen::Vector3d& corner) { corners[count++] = corner; }

  /// The part on one side of a height (Sutherland and Hodgman, 1974).
  [[nodiscard]] Slice cut(double height, bool keep_above) const {
    Slice kept;
    const auto inside = [&](const Eigen::Vector3d& p) {
      return keep_above ? p.z() >= height : p.z() <= height;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& here = corners[i];
      const Eigen::Vector3d& next = corners[(i + 1) % count];
      if (inside(here)) kept.add(here);
      if (inside(here) != inside(next))
        kept.add(here + (next - here) * ((height - here.z()) / (next.z() - here.z())));
    }
    return kept;
  }

  /// Seen from above: the distance of `point`, and the point of the slice nearest to it.
  [[nodiscard]] std::pair<double, Eigen::Vector3d> from_above(const Eigen::Vector2d& point) const {
    std::pair<double, Eigen::Vector3d> best{kNever, Eigen::Vector3d::Zero()};
    bool left = count > 2, right = count > 2;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& a = corners[i];
      const Eigen::Vector3d& b = corners[(i + 1) % count];
      const Eigen::Vector3d at = nearest_on(a, b, point);
      const double distance = (at.head<2>() - point).norm();
      if (distance < best.first) best = {distance, at};
      const Eigen::Vector2d edge = (b - a).head<2>(), to = point - a.head<2>();
      const double side = edge.x() * to.y() - edge.y() * to.x();
      left = left && side > 0.0;
      right = right && side < 0.0;
    }
    if (left || right) best.first = 0.0;
    return best;
  }
};

/// To a convex solid, by the triangles of its faces.
template <typename Holds>
Gap gap_to_faces(const Hull& hull, const std::vector<std::array<Eigen::Vector3d, 3>>& faces,
                 const Holds& holds) {
  Gap best{kNever, Eigen::Vector3d::Zero()};
  for (const auto& face : faces) {
    const Gap gap = gap_to(hull, face);
    if (gap.gap < best.gap) best = gap;
  }
  // Where the whole hull is within the solid, all faces are away from it.
  if (best.gap > 0.0 &&
      holds(Eigen::Vector3d(hull.centre.x(), hull.centre.y(), 0.5 * (hull.bottom + hull.top))))
    best.gap = -hull.radius;
  return best;
}

}  // namespace

double Hull::bound(const Eigen::AlignedBox3d& box) const {
  if (!meets(box.min().z(), box.max().z())) return kNever;
  const Eigen::Vector2d low = box.min().head<2>(), high = box.max().head<2>();
  const Eigen::Vector2d nearest = centre.cwiseMax(low).cwiseMin(high);
  return std::max(0.0, (centre - nearest).norm() - radius);
}

Gap gap_to(const Hull& hull, const Box& box, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d half = 0.5 * box.size;
  const int up = vertical_axis(pose);
  if (up >= 0) return gap_to_upright(hull, half, pose, up);
  std::vector<std::array<Eigen::Vector3d, 3>> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double v) -> Eigen::Vector3d {
        Eigen::Vector3d local;
        local[axis] = side * half[axis];
        local[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        local[(axis + 2) % 3] = v * half[(axis + 2) % 3];
        return pose * local;
      };
      for (const double half_face : {-1.0, 1.0})
        faces.push_back({corner(-1, -1), corner(1, 1), corner(half_face, -half_face)});
    }
  return gap_to_faces(hull, faces, [&](const Eigen::Vector3d& point) {
    return ((half - (pose.inverse() * point).cwiseAbs()).array() >= 0.0).all();
  });
}

Gap gap_to(const Hull& hull, const Cylinder& cylinder, const Eigen::Isometry3d& pose) {
  const double half = 0.5 * cylinder.length;
  if (std::abs(pose.linear()(2, 2)) > kUpright) {
    const double z = pose.translation().z();
    const Eigen::Vector2d away = hull.centre - pose.translation().head<2>();
    const double distance = away.norm();
    const Eigen::Vector2d out =
        distance > 1e-12 ? Eigen::Vector2d(away / distance) : Eigen::Vector2d::UnitX();
    const Eigen::Vector2d at = pose.translation().head<2>() + cylinder.radius * out;
    return {distance - cylinder.radius - hull.radius,
            {at.x(), at.y(), shared_height(hull, z - half, z + half)}};
  }
  std::vector<std::array<Eigen::Vector3d, 3>> faces;
  const auto corner = [&](int side, double end) -> Eigen::Vector3d {
    const double turn = 2.0 * navvi_types::kPi * side / kSides;
    return pose * Eigen::Vector3d(cylinder.radius * std::cos(turn),
                                  cylinder.radius * std::sin(turn), end * half);
  };
  for (int side = 0; side < kSides; ++side) {
    faces.push_back({corner(side, -1), corner(side, 1), corner(side + 1, -1)});
    faces.push_back({corner(side, 1), corner(side + 1, -1), corner(side + 1, 1)});
    for (const double end : {-1.0, 1.0})
      faces.push_back(
          {corner(side, end), corner(side + 1, end), pose * Eigen::Vector3d(0.0, 0.0, end * half)});
  }
  return gap_to_faces(hull, faces, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d local = pose.inverse() * point;
    return local.head<2>().norm() <= cylinder.radius && std::abs(local.z()) <= half;
  });
}

Gap gap_to(const Hull& hull, const Sphere& sphere, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d centre = pose.translation();
  const double z = std::clamp(centre.z(), hull.bottom, hull.top);
  const double off = centre.z() - z;
  const double radius = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - off * off));
  const Eigen::Vector2d away = hull.centre - centre.head<2>();
  const double distance = away.norm();
  const Eigen::Vector2d at =
      centre.head<2>() + (distance > 1e-12 ? Eigen::Vector2d(away * (radius / distance))
                                           : Eigen::Vector2d(radius, 0.0));
  return {distance - radius - hull.radius, {at.x(), at.y(), z}};
}

Gap gap_to(const Hull& hull, const std::array<Eigen::Vector3d, 3>& triangle) {
  const double low = std::min({triangle[0].z(), triangle[1].z(), triangle[2].z()});
  const double high = std::max({triangle[0].z(), triangle[1].z(), triangle[2].z()});
  if (!hull.meets(low, high)) return {kNever, Eigen::Vector3d::Zero()};
  Slice slice;
  for (const Eigen::Vector3d& corner : triangle) slice.add(corner);
  if (low < hull.bottom) slice = slice.cut(hull.bottom, true);
  if (high > hull.top) slice = slice.cut(hull.top, false);
  const auto [distance, nearest] = slice.from_above(hull.centre);
  return {distance - hull.radius, nearest};
}

}  // namespace navvi_sim::physics
