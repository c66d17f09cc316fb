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

/// The point of the convex polygon nearest to `p`. One outside is measured to every edge: by
/// rounding it may lie beyond one of several edges in line, and nearest to another.
/// \param corners  counter-clockwise, not empty \param at  the place of one of them
template <typename Corners, typename At>
Point nearest_in_convex(Point p, const Corners& corners, const At& at) {
  bool inside = true;
  Point a = at(corners.back());
  for (const auto& corner : corners) {
    const Point b = at(corner);
    inside = inside && cross(b - a, p - a) >= 0.0;
    a = b;
  }
  if (inside) return p;
  Point best = a;
  for (const auto& corner : corners) {
    const Point b = at(corner);
    const Point candidate = nearest_on_segment(p, a, b);
    if (distance(candidate, p) < distance(best, p)) best = candidate;
    a = b;
  }
  return best;
}
inline Point nearest_in_convex(Point p, const std::vector<Point>& corners) {
  return nearest_in_convex(p, corners, [](Point corner) { return corner; });
}

using Path = std::vector<Point>;

/// m
inline double length_of(const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += distance(path[i - 1], path[i]);
  return sum;
}

/// m, from the point to the path, which is not empty
inline double away(Point point, const Path& path) {
  double least = distance(point, path.front());
  for (std::size_t i = 1; i < path.size(); ++i)
    least = std::min(least, distance(point, nearest_on_segment(point, path[i - 1], path[i])));
  return least;
}

}  // namespace navvi_nav
