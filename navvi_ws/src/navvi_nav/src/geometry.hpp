#pragma once

#include <cmath>
#include <navvi_floor/geometry.hpp>
#include <navvi_types/angles.hpp>
#include <vector>

namespace navvi_nav {

namespace map = navvi_floor;
using navvi_floor::Cylinder;
using navvi_floor::Point;
using navvi_types::kPi;

inline std::size_t slot(int index) { return static_cast<std::size_t>(index); }

/// Clockwise angle in [-pi, pi] by which to turn from direction `from` to direction `to`.
inline double clockwise(Point from, Point to) { return std::atan2(cross(to, from), dot(to, from)); }

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

using Path = std::vector<Point>;

/// m
inline double length_of(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
  return sum;
}

}  // namespace navvi_nav
