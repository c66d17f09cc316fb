#pragma once

#include <cmath>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

/// What a root, a corner or the start, sees through a portal: a cone of straight ways into
/// `polygon`.
struct Cone {
  double cost;  ///< m, from the start to the root
  Point right;  ///< its border, from the root
  Point left;
  int root;          ///< vertex, or one beyond the last: the start
  int polygon;       ///< that is entered; -1: the goal is seen
  int portal_right;  ///< ends of the portal, as seen on the way
  int portal_left;
  bool right_end;  ///< the border runs through the portal's end
  bool left_end;

  /// The part of the portal that the root sees; places in m.
  struct Part {
    Point right;
    Point left;
  };
  [[nodiscard]] Part part(Point root, Point portal_right_at, Point portal_left_at) const {
    return {right_end ? portal_right_at
                      : crossing(right, root, portal_right_at, portal_left_at, portal_right_at),
            left_end ? portal_left_at
                     : crossing(left, root, portal_right_at, portal_left_at, portal_left_at)};
  }

  /// m, from the root through the portal to the goal if nothing else stood between. The goal is
  /// taken to lie beyond the portal: the way there and its mirror image are as long.
  [[nodiscard]] double straight(Point root_at, Point portal_right_at, Point portal_left_at,
                                Point goal) const {
    const Point edge = portal_left_at - portal_right_at;
    Point target = goal - portal_right_at;
    const double inside = cross(edge, target);
    if (inside > 0.0) {
      const double k = 2.0 * inside / dot(edge, edge);
      target = target + Point{k * edge.y, -k * edge.x};
    }
    target = target + (portal_right_at - root_at);
    const bool on_end = root == portal_right || root == portal_left;
    const bool over_right = !on_end && cross(right, target) < 0.0;
    const bool over_left = !on_end && !over_right && cross(left, target) > 0.0;
    if (!over_right && !over_left) return norm(target);
    const Point border = over_right ? right : left;
    const Point x =
        (over_right ? right_end : left_end)
            ? border
            : crossing(border, {}, portal_right_at - root_at, portal_left_at - root_at, {});
    return norm(x) + distance(x, target);
  }

 private:
  /// Where a border crosses the line of the portal. \param otherwise  if they run side by side
  static Point crossing(Point border, Point root, Point portal_right_at, Point portal_left_at,
                        Point otherwise) {
    const auto extent = [](Point a) { return std::abs(a.x) + std::abs(a.y); };
    const Point edge = portal_left_at - portal_right_at;
    const double across = cross(border, edge);
    if (std::abs(across) < 1e-9 * extent(border) * extent(edge)) return otherwise;
    return root + (cross(portal_right_at - root, edge) / across) * border;
  }
};

}  // namespace navvi_nav
