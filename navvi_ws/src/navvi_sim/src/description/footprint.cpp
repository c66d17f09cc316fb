#include "description/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace navvi_sim {
namespace {

constexpr int kRimPoints = 16;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The direction out of `polygon` over its edge from corner i; nullopt where two corners are one.
std::optional<Eigen::Vector2d> outwards_of(const Polygon& polygon, std::size_t i) {
  const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
  const double length = edge.norm();
  if (length < 1e-12) return std::nullopt;
  return Eigen::Vector2d(edge.y() / length, -edge.x() / length);
}

/// True if a line along one of `a`'s edges separates the two by `gap`.
bool separated(const Polygon& a, const Polygon& b, double gap) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::optional<Eigen::Vector2d> outwards = outwards_of(a, i);
    if (!outwards) continue;
    double nearest = std::numeric_limits<double>::max();
    for (const Eigen::Vector2d& corner : b)
      nearest = std::min(nearest, outwards->dot(corner - a[i]));
    if (nearest > 0.0 && nearest >= gap) return true;
  }
  return false;
}

}  // namespace

Polygon convex_hull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Polygon hull;
  const auto grow = [&hull](const Eigen::Vector2d& point, std::size_t least) {
    while (hull.size() >= least &&
           cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Eigen::Vector2d& point : points) grow(point, 2);
  const std::size_t lower = hull.size() + 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) grow(*point, lower);
  hull.pop_back();
  return hull;
}

bool overlap(const Polygon& a, const Polygon& b, double gap) {
  return !separated(a, b, gap) && !separated(b, a, gap);
}

Ground::Ground(const Polygon& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (const auto outwards = outwards_of(polygon, i)) edges_.push_back({polygon[i], *outwards});
}

bool Ground::holds(const Eigen::Vector2d& point, double gap) const {
  return std::none_of(edges_.begin(), edges_.end(), [&](const Edge& edge) {
    const double away = edge.outwards.dot(point - edge.corner);
    return away > 0.0 && away >= gap;
  });
}

std::pair<double, double> Ground::along_x(double y, double gap) const {
  double low = std::numeric_limits<double>::lowest(), high = std::numeric_limits<double>::max();
  for (const Edge& edge : edges_) {
    const double left = gap - edge.outwards.y() * (y - edge.corner.y());
    const double x = edge.outwards.x();
    if (x > 0.0) high = std::min(high, edge.corner.x() + left / x);
    if (x < 0.0) low = std::max(low, edge.corner.x() + left / x);
    if (x == 0.0 && left < 0.0) return {high, low};
  }
  return {low, high};
}

std::vector<Eigen::Vector3d> hull_points(const Geometry& geometry) {
  std::vector<Eigen::Vector3d> points;
  const auto rim = [&](double radius, double z) {
    const double outer = radius / std::cos(kPi / kRimPoints);
    for (int i = 0; i < kRimPoints; ++i) {
      const double angle = 2.0 * kPi * (i + 0.5) / kRimPoints;
      points.emplace_back(outer * std::cos(angle), outer * std::sin(angle), z);
    }
  };
  if (const auto* box = std::get_if<Box>(&geometry)) {
    for (int corner = 0; corner < 8; ++corner)
      points.push_back(0.5 *
                       box->size.cwiseProduct(Eigen::Vector3d(
                           (corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1)));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    rim(cylinder->radius, 0.5 * cylinder->length);
    rim(cylinder->radius, -0.5 * cylinder->length);
  } else if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    rim(sphere->radius, 0.0);
    points.emplace_back(0.0, 0.0, sphere->radius);
    points.emplace_back(0.0, 0.0, -sphere->radius);
  } else {
    for (const Eigen::Vector3f& vertex : std::get<std::shared_ptr<const Mesh>>(geometry)->vertices)
      points.push_back(vertex.cast<double>());
  }
  return points;
}

double yaw_of(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d x = pose.linear().col(0);
  return x.head<2>().norm() > 1e-9 ? std::atan2(x.y(), x.x()) : 0.0;
}

Eigen::Quaterniond tilt_of(const Eigen::Isometry3d& pose) {
  return Eigen::AngleAxisd(-yaw_of(pose), Eigen::Vector3d::UnitZ()) *
         Eigen::Quaterniond(pose.linear());
}

Footprint footprint_of(const Thing& thing, const Eigen::Quaterniond& tilt) {
  Footprint print;
  print.bottom = std::numeric_limits<double>::max();
  print.top = std::numeric_limits<double>::lowest();
  std::vector<Eigen::Vector2d> points;
  for (const Shape& shape : thing.shapes) {
    const Eigen::Isometry3d pose = tilt * shape.pose;
    const auto* sphere = std::get_if<Sphere>(&shape.geometry);
    // A tilted sphere is a sphere.
    const Eigen::Isometry3d placed =
        sphere ? Eigen::Isometry3d(Eigen::Translation3d(pose.translation())) : pose;
    const auto* cylinder = std::get_if<Cylinder>(&shape.geometry);
    const bool upright = cylinder && std::abs(pose.linear()(2, 2)) > 1.0 - 1e-9;
    // What is round seen from above reaches as far as its radius, not as the corners around it.
    const double round = sphere ? sphere->radius : upright ? cylinder->radius : 0.0;
    const auto reach = [&](const Eigen::Vector2d& at, double more) {
      print.front = std::max(print.front, at.x() + more);
      print.back = std::max(print.back, -at.x() + more);
      print.side = std::max(print.side, std::abs(at.y()) + more);
      print.radius = std::max(print.radius, at.norm() + more);
    };
    if (round > 0.0) reach(placed.translation().head<2>(), round);
    for (const Eigen::Vector3d& local : hull_points(shape.geometry)) {
      const Eigen::Vector3d point = placed * local;
      if (round == 0.0) reach(point.head<2>(), 0.0);
      print.bottom = std::min(print.bottom, point.z());
      print.top = std::max(print.top, point.z());
      points.emplace_back(point.x(), point.y());
    }
  }
  print.hull = convex_hull(std::move(points));
  return print;
}

navvi_types::MovingThing extent_of(const Footprint& print) {
  navvi_types::MovingThing extent;
  extent.radius = print.radius;
  const double length = 2.0 * std::max(print.front, print.back);
  const double width = 2.0 * print.side;
  if (length * width >= kPi * print.radius * print.radius) return extent;
  extent.radius = std::max(print.radius, 0.5 * Eigen::Vector2d(length, width).norm());
  extent.length = length;
  extent.width = width;
  return extent;
}

}  // namespace navvi_sim
