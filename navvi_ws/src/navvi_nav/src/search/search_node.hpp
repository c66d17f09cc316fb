#pragma once

#include <cmath>

#include "mesh/mesh.hpp"

namespace navvi_nav::search {

/// A search node of Polyanya: the interval of a portal that is visible from a root, which is a
/// corner or the start, and the polygon behind that portal. The interval is given by the directions
/// from the root to its ends.
struct SearchNode {
  double cost;  ///< m, from the start to the root
  Point right;  ///< direction of the right border, from the root
  Point left;
  int root;          ///< vertex, or one beyond the last: the start
  int polygon;       ///< that is entered; -1: the goal is visible
  int portal_right;  ///< vertices, as seen on the way
  int portal_left;
  bool right_end;  ///< the right border runs through the portal's right vertex
  bool left_end;

  /// The visible part of the portal. \param root_at, portal_right_at, portal_left_at  m
  [[nodiscard]] mesh::Interval interval(Point root_at, Point portal_right_at,
                                        Point portal_left_at) const {
    return {
        right_end ? portal_right_at
                  : intersection(right, root_at, portal_right_at, portal_left_at, portal_right_at),
        left_end ? portal_left_at
                 : intersection(left, root_at, portal_right_at, portal_left_at, portal_left_at)};
  }

  /// The heuristic of Polyanya: m, from the root through the interval to the goal if nothing else
  /// is in the way. A goal on the root's side of the portal is mirrored at it, which keeps the
  /// length. \param turn  m, price of a turn
  [[nodiscard]] double heuristic(Point root_at, Point portal_right_at, Point portal_left_at,
                                 Point goal, double turn) const {
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
            : intersection(border, {}, portal_right_at - root_at, portal_left_at - root_at, {});
    return norm(x) + distance(x, target) + turn;
  }

 private:
  /// Where a border crosses the line of the portal. \param otherwise  if they are parallel
  static Point intersection(Point border, Point root_at, Point portal_right_at,
                            Point portal_left_at, Point otherwise) {
    const auto extent = [](Point a) { return std::abs(a.x) + std::abs(a.y); };
    const Point edge = portal_left_at - portal_right_at;
    const double across = cross(border, edge);
    if (std::abs(across) < 1e-9 * extent(border) * extent(edge)) return otherwise;
    return root_at + (cross(portal_right_at - root_at, edge) / across) * border;
  }
};

}  // namespace navvi_nav::search
