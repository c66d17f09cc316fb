#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace navvi_floor {

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

/// A moving thing, or a part of a long one, as a vertical cylinder on the floor (R-NAV-4).
struct Cylinder {
  std::uint32_t id = 0;  ///< of the thing: several cylinders may be one thing
  Point center;
  double radius = 0.0;  ///< m, > 0
  Point velocity;       ///< m/s
  /// s, that it has stood since it was seen to move; infinite: it never was
  double stood = std::numeric_limits<double>::infinity();
};

}  // namespace navvi_floor
