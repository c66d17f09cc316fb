#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <navvi_types/angles.hpp>
#include <vector>

namespace navvi_nav {

using navvi_types::kPi;

/// A point or a difference of points on the floor, frame map, m.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double k, Point a) { return {k * a.x, k * a.y}; }
inline bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
/// Positive where `b` lies counter-clockwise of `a`.
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
/// Clockwise angle in [-pi, pi] by which to turn from direction `from` to direction `to`.
inline double clockwise(Point from, Point to) { return std::atan2(cross(to, from), dot(to, from)); }
inline double norm(Point a) { return std::sqrt(dot(a, a)); }
inline double distance(Point a, Point b) { return norm(b - a); }
inline bool finite(Point a) { return std::isfinite(a.x) && std::isfinite(a.y); }

/// The point of the segment `a`-`b` nearest to `p`.
inline Point nearest_on_segment(Point p, Point a, Point b) {
  const Point d = b - a;
  const double length2 = dot(d, d);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  return a + t * d;
}

/// True if `p` lies in the convex polygon, borders included.
/// \param corners  counter-clockwise
inline bool convex_contains(const std::vector<Point>& corners, Point p) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point a = corners[k];
    const Point b = corners[k + 1 < corners.size() ? k + 1 : 0];
    if (cross(b - a, p - a) < 0.0) return false;
  }
  return true;
}

/// The point of the convex polygon nearest to `p`.
/// \param corners  counter-clockwise, not empty
inline Point nearest_in_convex(Point p, const std::vector<Point>& corners) {
  if (convex_contains(corners, p)) return p;
  Point best = corners[0];
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point candidate =
        nearest_on_segment(p, corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
    if (distance(candidate, p) < distance(best, p)) best = candidate;
  }
  return best;
}

/// A moving thing, or a part of a long one, as a vertical cylinder on the floor (R-NAV-4).
struct Cylinder {
  std::uint32_t id = 0;  ///< of the thing: several cylinders may be one thing
  Point center;
  double radius = 0.0;  ///< m, > 0
  Point velocity;       ///< m/s
  /// s, that it has stood since it was seen to move; infinite: it never was
  double stood = std::numeric_limits<double>::infinity();
};

using Path = std::vector<Point>;

/// m
inline double length_of(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
  return sum;
}

}  // namespace navvi_nav
