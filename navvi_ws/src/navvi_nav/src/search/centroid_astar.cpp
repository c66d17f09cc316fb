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

}  // namespace

Corridor centroid_astar(const mesh::Mesh& mesh, const mesh::Mesh::Place& start,
                        const mesh::Mesh::Place& goal, double alpha) {
  Corridor out;
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
  for (int index = goal.polygon; index != start.polygon; index = at(index).parent) {
    const Node& node = at(index);
    const mesh::Portal& portal =
        mesh.polygon(node.parent).portals[static_cast<std::size_t>(node.portal)];
    out.portals.push_back({mesh.at(portal.right), mesh.at(portal.left)});
  }
  std::reverse(out.portals.begin(), out.portals.end());
  return out;
}

}  // namespace navvi_nav::search
