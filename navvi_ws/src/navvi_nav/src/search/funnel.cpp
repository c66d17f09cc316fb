#include "search/funnel.hpp"

namespace navvi_nav::search {
namespace {

constexpr double kTouch = 1e-10;  // m

/// Positive where `c` lies left of the ray from `a` through `b`.
double side(Point a, Point b, Point c) { return cross(b - a, c - a); }

bool lies_on(Point point, const mesh::Interval& portal) {
  return distance(nearest_on_segment(point, portal.right, portal.left), point) < kTouch;
}

}  // namespace

Path funnel(Point start, Point goal, const std::vector<mesh::Interval>& portals) {
  Path path{start};
  const auto append = [&path](Point point) {
    if (!(path.back() == point)) path.push_back(point);
  };
  const std::size_t count = portals.size() + 1;  // the goal is the last portal, of no width
  const auto left_of = [&](std::size_t i) { return i < portals.size() ? portals[i].left : goal; };
  const auto right_of = [&](std::size_t i) { return i < portals.size() ? portals[i].right : goal; };

  Point apex = start;
  Point left = start;
  Point right = start;
  std::size_t left_at = 0;
  std::size_t right_at = 0;
  // A portal that the start lies on is behind it; as a funnel it would be open to both sides.
  std::size_t first = 0;
  while (first < portals.size() && lies_on(start, portals[first])) ++first;
  for (std::size_t i = first; i < count; ++i) {
    const Point next_right = right_of(i);
    if (side(apex, right, next_right) >= 0.0) {
      if (apex == right || side(apex, left, next_right) < 0.0) {
        right = next_right;
        right_at = i;
      } else {  // the right crossed the left: the left corner is on the path
        append(left);
        apex = right = left;
        i = right_at = left_at;
        continue;
      }
    }
    const Point next_left = left_of(i);
    if (side(apex, left, next_left) <= 0.0) {
      if (apex == left || side(apex, right, next_left) > 0.0) {
        left = next_left;
        left_at = i;
      } else {
        append(right);
        apex = left = right;
        i = left_at = right_at;
        continue;
      }
    }
  }
  append(goal);
  return path;
}

}  // namespace navvi_nav::search
