#include "navvi_nav/search.hpp"

#include <limits>
#include <queue>
#include <tuple>

namespace navvi_nav {
namespace {

struct Node {
  double cost = std::numeric_limits<double>::infinity();  // m, from the start
  int parent = -1;
  int link = -1;  // of the parent
  bool closed = false;
};

struct Open {
  double f = 0.0;
  int triangle = 0;
};

bool operator>(const Open& a, const Open& b) {
  return std::tie(a.f, a.triangle) > std::tie(b.f, b.triangle);
}

}  // namespace

Corridor centroid_astar(const Mesh& mesh, const Mesh::Place& start, const Mesh::Place& goal,
                        double alpha) {
  Corridor out;
  std::vector<Node> nodes(mesh.triangles.size());
  const auto at = [&nodes](int triangle) -> Node& {
    return nodes[static_cast<std::size_t>(triangle)];
  };
  const auto triangle = [&mesh](int index) -> const Triangle& {
    return mesh.triangles[static_cast<std::size_t>(index)];
  };
  const auto position = [&](int index) {
    if (index == start.triangle) return start.point;
    return index == goal.triangle ? goal.point : triangle(index).centroid();
  };
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  at(start.triangle).cost = 0.0;
  open.push({alpha * distance(start.point, goal.point), start.triangle});
  while (!open.empty()) {
    const int current = open.top().triangle;
    open.pop();
    Node& node = at(current);
    if (node.closed) continue;
    node.closed = true;
    ++out.nodes_expanded;
    if (current == goal.triangle) {
      out.found = true;
      break;
    }
    const Point here = position(current);
    const auto& links = triangle(current).links;
    for (std::size_t i = 0; i < links.size(); ++i) {
      Node& next = at(links[i].to);
      if (next.closed) continue;
      const Point there = position(links[i].to);
      const double cost = node.cost + distance(here, there);
      if (cost >= next.cost) continue;
      next.cost = cost;
      next.parent = current;
      next.link = static_cast<int>(i);
      open.push({cost + alpha * distance(there, goal.point), links[i].to});
    }
  }
  if (!out.found) return out;
  for (int index = goal.triangle; index != start.triangle; index = at(index).parent) {
    const Node& node = at(index);
    out.links.push_back(triangle(node.parent).links[static_cast<std::size_t>(node.link)]);
  }
  std::reverse(out.links.begin(), out.links.end());
  return out;
}

}  // namespace navvi_nav
