#pragma once

#include <algorithm>

#include "description/footprint.hpp"
#include "generate/layout.hpp"

namespace navvi_sim {

/// m, from a point to a convex polygon; 0 within it.
inline double distance(const Eigen::Vector2d& point, const Polygon& polygon) {
  if (overlap(polygon, {point}, 0.0)) return 0.0;
  double least = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& from = polygon[i];
    const Eigen::Vector2d along = polygon[(i + 1) % polygon.size()] - from;
    const double share = std::clamp(along.dot(point - from) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (from + share * along - point).norm());
  }
  return least;
}

/// There and round again by these corners.
inline Route through(const std::vector<Eigen::Vector2d>& corners, double speed = 1.0,
                     double pause = 0.0) {
  Route route;
  for (const Eigen::Vector2d& corner : corners) route.waypoints.push_back({corner, pause});
  route.speed = speed;
  return route;
}

/// The layout that ships as "warehouse".
inline WorldDescription warehouse(std::uint64_t seed) {
  return generate::layout("warehouse", generate::preset("warehouse").value(), seed);
}

}  // namespace navvi_sim
