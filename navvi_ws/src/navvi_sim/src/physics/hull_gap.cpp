#include "physics/hull_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_sim::physics {
namespace {

constexpr double kFar = std::numeric_limits<double>::max();
constexpr double kUpright = 1.0 - 1e-12;  // of an axis's z
constexpr double kNoNearer = 1e-7;        // m, not worth a search
constexpr int kAlternations = 2000;
constexpr int kSections = 44;  // of a golden section search, which shrinks by 0.62 each time

/// Puts a horizontal and a vertical gap together: beside each other, above each other, or
/// overlapping by the smaller of the two.
double join(double aside, double above) {
  return aside > 0.0 && above > 0.0 ? std::hypot(aside, above) : std::max(aside, above);
}

/// m, between the hull and heights from `bottom` to `top`; negative where they overlap.
double gap_above(const Hull& hull, double bottom, double top) {
  return std::max(bottom - hull.top, hull.bottom - top);
}

/// A height of both, or the one of the body that is nearest to the hull.
double shared_height(const Hull& hull, double bottom, double top) {
  if (bottom > hull.top) return bottom;
  if (top < hull.bottom) return top;
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
  Eigen::Vector2d local(x.dot(away), y.dot(away));
  const Eigen::Vector2d reach(half[ahead], half[aside]);
  Eigen::Vector2d nearest = local.cwiseMax(-reach).cwiseMin(reach);
  const double bottom = pose.translation().z() - half[up], top = pose.translation().z() + half[up];
  const double above = gap_above(hull, bottom, top);
  double beside;
  if (nearest == local) {
    const Eigen::Vector2d depth = reach - local.cwiseAbs();
    const int axis = depth.x() < depth.y() ? 0 : 1;
    beside = -depth[axis] - hull.radius;
    if (above <= 0.0) nearest[axis] = local[axis] < 0.0 ? -reach[axis] : reach[axis];
  } else {
    beside = (local - nearest).norm() - hull.radius;
  }
  const Eigen::Vector2d at = pose.translation().head<2>() + nearest.x() * x + nearest.y() * y;
  return {join(beside, above), {at.x(), at.y(), shared_height(hull, bottom, top)}};
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
    std::pair<double, Eigen::Vector3d> best{kFar, Eigen::Vector3d::Zero()};
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

template <typename Function>
std::pair<double, double> least(Function value) {
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0, high = 1.0;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = value(a), at_b = value(b);
  for (int i = 0; i < kSections; ++i) {
    if (at_a <= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = value(a = high - kGolden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = value(b = low + kGolden * (high - low));
    }
  }
  std::pair<double, double> best{at_a, a};
  for (const double end : {0.0, 1.0}) best = std::min(best, {value(end), end});
  return best;
}

/// To a triangle of which no point within the hull's heights is nearest: that point is on an edge,
/// along which the distance is convex; or it is the foot, within the triangle, of the point of the
/// hull's end that lies farthest towards the triangle's plane.
Gap gap_to_slanted(const Hull& hull, const std::array<Eigen::Vector3d, 3>& triangle, bool above) {
  Gap best{kFar, Eigen::Vector3d::Zero()};
  const auto take = [&](const Eigen::Vector3d& point) {
    const double distance = hull.distance(point);
    if (distance < best.gap) best = {distance, point};
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& from = triangle[i];
    const Eigen::Vector3d along = triangle[(i + 1) % 3] - from;
    take(from +
         least([&](double share) { return hull.distance(from + share * along); }).second * along);
  }
  const Eigen::Vector3d ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0];
  const Eigen::Vector3d across = ab.cross(ac);
  const double area = across.norm();
  if (area < 1e-12) return best;
  const Eigen::Vector3d normal = across / area;
  Eigen::Vector3d end(hull.centre.x(), hull.centre.y(), above ? hull.top : hull.bottom);
  const double side = normal.dot(end - triangle[0]) > 0.0 ? -1.0 : 1.0;
  const double level = normal.head<2>().norm();
  if (level > 1e-9) end.head<2>() += side * hull.radius / level * normal.head<2>();
  const Eigen::Vector3d foot = end - normal.dot(end - triangle[0]) * normal;
  const double u = normal.dot((foot - triangle[0]).cross(ac)) / area;
  const double v = normal.dot(ab.cross(foot - triangle[0])) / area;
  if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) take(foot);
  return best;
}

}  // namespace

double Hull::distance(const Eigen::Vector3d& point) const {
  const double aside = (point.head<2>() - centre).norm() - radius;
  const double above = std::max(point.z() - top, bottom - point.z());
  return std::max(0.0, join(aside, above));
}

double Hull::bound(const Eigen::AlignedBox3d& box) const {
  const Eigen::Vector2d low = box.min().head<2>(), high = box.max().head<2>();
  const Eigen::Vector2d nearest = centre.cwiseMax(low).cwiseMin(high);
  const double aside = (centre - nearest).norm() - radius;
  return std::max(0.0, join(aside, gap_above(*this, box.min().z(), box.max().z())));
}

Gap gap_to(const Hull& hull, const Box& box, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d half = 0.5 * box.size;
  const int up = vertical_axis(pose);
  if (up >= 0) return gap_to_upright(hull, half, pose, up);
  Gap best{kFar, Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double u, double v) -> Eigen::Vector3d {
        Eigen::Vector3d local;
        local[axis] = side * half[axis];
        local[(axis + 1) % 3] = u * half[(axis + 1) % 3];
        local[(axis + 2) % 3] = v * half[(axis + 2) % 3];
        return pose * local;
      };
      for (const double half_face : {-1.0, 1.0}) {
        const Gap gap =
            gap_to(hull, {corner(-1, -1), corner(1, 1), corner(half_face, -half_face)}, best.gap);
        if (gap.gap < best.gap) best = gap;
      }
    }
  // Where the whole hull is within the box, all faces are away from it.
  const Eigen::Vector3d middle(hull.centre.x(), hull.centre.y(), 0.5 * (hull.bottom + hull.top));
  const Eigen::Vector3d local = pose.inverse() * middle;
  if (best.gap > 0.0 && ((half - local.cwiseAbs()).array() >= 0.0).all()) best.gap = -best.gap;
  return best;
}

Gap gap_to(const Hull& hull, const Cylinder& cylinder, const Eigen::Isometry3d& pose) {
  const double half = 0.5 * cylinder.length;
  if (std::abs(pose.linear()(2, 2)) > kUpright) {
    const double bottom = pose.translation().z() - half, top = pose.translation().z() + half;
    const Eigen::Vector2d away = hull.centre - pose.translation().head<2>();
    const double distance = away.norm();
    const double above = gap_above(hull, bottom, top);
    const bool over = above > 0.0 && distance < cylinder.radius;
    const Eigen::Vector2d out =
        distance > 1e-12 ? Eigen::Vector2d(away / distance) : Eigen::Vector2d::UnitX();
    const Eigen::Vector2d at =
        pose.translation().head<2>() + (over ? distance : cylinder.radius) * out;
    return {join(distance - cylinder.radius - hull.radius, above),
            {at.x(), at.y(), shared_height(hull, bottom, top)}};
  }
  // From one body to the nearest point of the other, and back: this ends at the two nearest points
  // (Cheney and Goldstein, 1959).
  const Eigen::Isometry3d to_local = pose.inverse();
  Eigen::Vector3d on_hull(hull.centre.x(), hull.centre.y(), 0.5 * (hull.bottom + hull.top));
  Eigen::Vector3d on_cylinder = Eigen::Vector3d::Zero();
  double gap = kFar;
  for (int i = 0; i < kAlternations; ++i) {
    Eigen::Vector3d local = to_local * on_hull;
    const double radius = local.head<2>().norm();
    if (radius > cylinder.radius) local.head<2>() *= cylinder.radius / radius;
    local.z() = std::clamp(local.z(), -half, half);
    on_cylinder = pose * local;
    const Eigen::Vector2d away = on_cylinder.head<2>() - hull.centre;
    const double distance = away.norm();
    on_hull = on_cylinder;
    if (distance > hull.radius) on_hull.head<2>() = hull.centre + away * (hull.radius / distance);
    on_hull.z() = std::clamp(on_hull.z(), hull.bottom, hull.top);
    const double now = (on_hull - on_cylinder).norm();
    if (gap - now < 1e-9) break;
    gap = now;
  }
  return {(on_hull - on_cylinder).norm(), on_cylinder};
}

Gap gap_to(const Hull& hull, const Sphere& sphere, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d centre = pose.translation();
  const Eigen::Vector2d away = centre.head<2>() - hull.centre;
  const double distance = away.norm();
  const double aside = distance - hull.radius;
  const double above = std::max(centre.z() - hull.top, hull.bottom - centre.z());
  Eigen::Vector3d on_hull = centre;
  if (aside > 0.0) on_hull.head<2>() = hull.centre + away * (hull.radius / distance);
  on_hull.z() = std::clamp(centre.z(), hull.bottom, hull.top);
  const Eigen::Vector3d towards = on_hull - centre;
  const double reach = towards.norm();
  const Eigen::Vector3d nearest =
      reach > 1e-12 ? Eigen::Vector3d(centre + towards * (sphere.radius / reach)) : centre;
  return {join(aside, above) - sphere.radius, nearest};
}

Gap gap_to(const Hull& hull, const std::array<Eigen::Vector3d, 3>& triangle, double limit) {
  Slice whole;
  for (const Eigen::Vector3d& corner : triangle) whole.add(corner);
  const double low = std::min({triangle[0].z(), triangle[1].z(), triangle[2].z()});
  const double high = std::max({triangle[0].z(), triangle[1].z(), triangle[2].z()});
  Gap best{kFar, Eigen::Vector3d::Zero()};
  if (low <= hull.top && high >= hull.bottom) {
    Slice beside = whole;
    if (low < hull.bottom) beside = beside.cut(hull.bottom, true);
    if (high > hull.top) beside = beside.cut(hull.top, false);
    const auto [distance, nearest] = beside.from_above(hull.centre);
    const double aside = distance - hull.radius;
    best = {aside > 0.0 ? aside : std::max(aside, gap_above(hull, low, high)), nearest};
    if (best.gap <= 0.0) return best;
  }
  for (const bool above : {true, false}) {
    if (above ? high <= hull.top : low >= hull.bottom) continue;
    const Slice part = whole.cut(above ? hull.top : hull.bottom, above);
    if (part.count == 0) continue;
    const double height = above ? std::max(0.0, low - hull.top) : std::max(0.0, hull.bottom - high);
    const double aside = std::max(0.0, part.from_above(hull.centre).first - hull.radius);
    if (std::hypot(aside, height) >= std::min(best.gap, limit) - kNoNearer) continue;
    const Gap found = gap_to_slanted(hull, triangle, above);
    if (found.gap < best.gap) best = found;
  }
  return best;
}

}  // namespace navvi_sim::physics
