#include "search/centroid_astar.hpp"

#include <limits>
#include <queue>
#include <tuple>

namespace navvi_nav::search {
namespace {

struct Node {
  double cost = std::numeric_limits<double>::infinity();  // m, from the start
  int parent = -1;
  int portal = -1;  // of the parent
  bool closed = false;
};

struct Open {
  double f = 0.0;
  int polygon = 0;
};

bool operator>(const Open& a, const Open& b) {
  return std::tie(a.f, a.polygon) > std::tie(b.f, b.polygon);
}

constexpr double kTouch = 1e-10;  // m

/// Positive where `c` lies left of the ray from `a` through `b`.
double side(Point a, Point b, Point c) { return cross(b - a, c - a); }

bool lies_on(Point point, const mesh::Interval& portal) {
  return distance(nearest_on_segment(point, portal.right, portal.left), point) < kTouch;
}

/// The portals that the parents of the goal's polygon lead through, from the start on.
std::vector<mesh::Interval> portals_to(int goal, int start, const std::vector<Node>& nodes,
                                       const mesh::Mesh& mesh) {
  std::vector<mesh::Interval> out;
  for (int index = goal; index != start;) {
    const Node& node = nodes[static_cast<std::size_t>(index)];
    const mesh::Portal& portal =
        mesh.polygon(node.parent).portals[static_cast<std::size_t>(node.portal)];
    out.push_back({mesh.at(portal.right), mesh.at(portal.left)});
    index = node.parent;
  }
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

Found centroid_astar(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                     const mesh::Mesh::Place& goal, double alpha) {
  Found out;
  std::vector<Node> nodes(mesh.polygons.size());
  const auto at = [&nodes](int polygon) -> Node& {
    return nodes[static_cast<std::size_t>(polygon)];
  };
  const auto position = [&](int index) {
    if (index == start.polygon) return start.point;
    return index == goal.polygon ? goal.point : mesh.centroid(index);
  };
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  at(start.polygon).cost = 0.0;
  open.push({alpha * distance(start.point, goal.point), start.polygon});
  while (!open.empty()) {
    const int current = open.top().polygon;
    open.pop();
    Node& node = at(current);
    if (node.closed) continue;
    node.closed = true;
    ++out.nodes_expanded;
    if (current == goal.polygon) {
      out.found = true;
      break;
    }
    const Point here = position(current);
    const auto& portals = mesh.polygon(current).portals;
    for (std::size_t i = 0; i < portals.size(); ++i) {
      Node& next = at(portals[i].to);
      if (next.closed) continue;
      const Point there = position(portals[i].to);
      const double cost = node.cost + distance(here, there);
      if (cost >= next.cost) continue;
      next.cost = cost;
      next.parent = current;
      next.portal = static_cast<int>(i);
      open.push({cost + alpha * distance(there, goal.point), portals[i].to});
    }
  }
  if (!out.found) return out;
  out.path = funnel(start.point, goal.point, portals_to(goal.polygon, start.polygon, nodes, mesh));
  return out;
}

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
