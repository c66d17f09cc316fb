#include "visibility_graph.hpp"

#include <queue>
#include <set>

namespace navvi_nav {
namespace {

constexpr double kNear = 1e-9;   // m
constexpr double kSquare = 2.0;  // m, of the grid in which walls are looked up

/// m, how far `c` lies left of the line from `a` through `b`
double left_of(Point a, Point b, Point c) { return cross(b - a, c - a) / norm(b - a); }

Point lower(Point a, Point b) { return {std::min(a.x, b.x) - kNear, std::min(a.y, b.y) - kNear}; }
Point upper(Point a, Point b) { return {std::max(a.x, b.x) + kNear, std::max(a.y, b.y) + kNear}; }

int sign(double value) { return value > kNear ? 1 : value < -kNear ? -1 : 0; }

}  // namespace

VisibilityGraph::VisibilityGraph(const mesh::Mesh& mesh) : mesh_(mesh) {
  around_.resize(mesh.vertices.size());
  std::vector<std::vector<Point>> in(mesh.vertices.size()), out(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const mesh::Polygon& polygon = mesh.polygons[i];
    std::set<std::pair<int, int>> open;
    for (const mesh::Portal& portal : polygon.portals) open.insert({portal.right, portal.left});
    for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
      const int from = polygon.corners[k];
      const int to = polygon.corners[(k + 1) % polygon.corners.size()];
      around_[static_cast<std::size_t>(from)].push_back(static_cast<int>(i));
      if (open.count({from, to}) > 0) continue;
      walls_.push_back({mesh.at(from), mesh.at(to)});
      out[static_cast<std::size_t>(from)].push_back(mesh.at(to) - mesh.at(from));
      in[static_cast<std::size_t>(to)].push_back(mesh.at(to) - mesh.at(from));
    }
  }
  Point low, high;
  for (const mesh::Vertex& vertex : mesh.vertices) {
    low = lower(low, vertex.at);
    high = upper(high, vertex.at);
  }
  wall_grid_ = polygon_grid_ = mesh::BoxGrid(low, high, kSquare);
  for (std::size_t i = 0; i < walls_.size(); ++i)
    wall_grid_.add(static_cast<int>(i), lower(walls_[i].from, walls_[i].to),
                   upper(walls_[i].from, walls_[i].to));
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    if (mesh.polygons[i].corners.empty()) continue;
    low = high = mesh.at(mesh.polygons[i].corners[0]);
    for (const int corner : mesh.polygons[i].corners) {
      low = lower(low, mesh.at(corner));
      high = upper(high, mesh.at(corner));
    }
    polygon_grid_.add(static_cast<int>(i), low, high);
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (in[i].empty()) continue;
    // One wall in, one out, and a left turn between them: a nook, where no path turns.
    if (in[i].size() == 1 && out[i].size() == 1 && cross(in[i][0], out[i][0]) > 0.0) continue;
    nodes_.push_back({mesh.vertices[i].at, static_cast<int>(i), {}});
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t j = i + 1; j < nodes_.size(); ++j) {
      if (!sees(nodes_[i], nodes_[j])) continue;
      const double away = navvi_floor::distance(nodes_[i].at, nodes_[j].at);
      nodes_[i].seen.emplace_back(static_cast<int>(j), away);
      nodes_[j].seen.emplace_back(static_cast<int>(i), away);
    }
  }
}

bool VisibilityGraph::inside(Point point) const {
  bool inside = false;
  polygon_grid_.visit(lower(point, point), upper(point, point), [&](int index) {
    const mesh::Polygon& polygon = mesh_.polygon(index);
    bool in = polygon.corners.size() > 2;
    for (std::size_t k = 0; in && k < polygon.corners.size(); ++k) {
      const Point a = mesh_.at(polygon.corners[k]);
      const Point b = mesh_.at(polygon.corners[(k + 1) % polygon.corners.size()]);
      in = left_of(a, b, point) >= -kNear;
    }
    inside = inside || in;
  });
  return inside;
}

bool VisibilityGraph::leaves(int vertex, Point direction) const {
  const Point here = mesh_.at(vertex);
  for (const int index : around_[static_cast<std::size_t>(vertex)]) {
    const auto& corners = mesh_.polygon(index).corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (corners[k] != vertex) continue;
      const Point next = mesh_.at(corners[(k + 1) % corners.size()]) - here;
      const Point before = mesh_.at(corners[(k + corners.size() - 1) % corners.size()]) - here;
      const double slack = 1e-7 * norm(direction);
      if (cross(next, direction) >= -slack * norm(next) &&
          cross(direction, before) >= -slack * norm(before))
        return true;
    }
  }
  return false;
}

bool VisibilityGraph::sees(const Node& a, const Node& b) const {
  if (a.at == b.at) return false;
  return leaves(a.vertex, b.at - a.at) && leaves(b.vertex, a.at - b.at) && visible(a.at, b.at);
}

bool VisibilityGraph::visible(Point a, Point b) const {
  if (a == b) return true;
  const double length = norm(b - a);
  const Point ahead = (1.0 / length) * (b - a);
  struct Touch {
    double along;
    bool left, right;  // something stands there, beside the line
  };
  std::vector<Touch> touches;
  std::vector<std::pair<double, std::pair<double, bool>>> beside;  // walls along the line
  bool crossed = false;
  const auto look = [&](int index) {
    const Wall& wall = walls_[static_cast<std::size_t>(index)];
    const int from = sign(left_of(a, b, wall.from));
    const int to = sign(left_of(a, b, wall.to));
    if (from * to < 0) {
      const int begin = sign(left_of(wall.from, wall.to, a));
      const int end = sign(left_of(wall.from, wall.to, b));
      crossed = crossed || begin * end < 0;
    }
    const double at = dot(wall.from - a, ahead);
    const double on = dot(wall.to - a, ahead);
    if (from == 0) touches.push_back({at, to > 0, to < 0});
    if (to == 0) touches.push_back({on, from > 0, from < 0});
    if (from == 0 && to == 0) beside.push_back({std::min(at, on), {std::max(at, on), on < at}});
  };
  const int parts = 1 + static_cast<int>(length / kSquare);
  for (int i = 0; i < parts; ++i) {
    const Point begin = a + (static_cast<double>(i) / parts) * (b - a);
    const Point end = a + (static_cast<double>(i + 1) / parts) * (b - a);
    wall_grid_.visit(lower(begin, end), upper(begin, end), look);
    if (crossed) return false;
  }
  std::vector<double> cuts{0.0, length};
  for (const Touch& touch : touches) {
    if (touch.along <= kNear || touch.along >= length - kNear) continue;
    cuts.push_back(touch.along);
    bool left = false, right = false;
    for (const Touch& other : touches) {
      if (std::abs(other.along - touch.along) > kNear) continue;
      left = left || other.left;
      right = right || other.right;
    }
    for (const auto& [low, rest] : beside) {
      if (touch.along < low - kNear || touch.along > rest.first + kNear) continue;
      (rest.second ? left : right) = true;  // what blocks lies on a wall's right
    }
    if (left && right) return false;
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i] - cuts[i - 1] < 2.0 * kNear) continue;
    if (!inside(a + (0.5 * (cuts[i] + cuts[i - 1])) * ahead)) return false;
  }
  return true;
}

std::vector<double> VisibilityGraph::reach(Point from) const {
  std::vector<double> out(nodes_.size(), kNoWay);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].at == from ||
        (leaves(nodes_[i].vertex, from - nodes_[i].at) && visible(from, nodes_[i].at)))
      out[i] = navvi_floor::distance(from, nodes_[i].at);
  }
  return out;
}

/// As reach(), on along any nodes. \param best  what reach() found
std::vector<double> VisibilityGraph::by_nodes(std::vector<double> best) const {
  using Open = std::pair<double, int>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i] < kNoWay) open.push({best[i], static_cast<int>(i)});
  }
  while (!open.empty()) {
    const auto [cost, node] = open.top();
    open.pop();
    if (cost > best[static_cast<std::size_t>(node)]) continue;
    for (const auto& [next, away] : nodes_[static_cast<std::size_t>(node)].seen) {
      if (cost + away >= best[static_cast<std::size_t>(next)]) continue;
      best[static_cast<std::size_t>(next)] = cost + away;
      open.push({cost + away, next});
    }
  }
  return best;
}

std::vector<std::vector<double>> VisibilityGraph::distances(
    const std::vector<mesh::Mesh::Place>& places) const {
  std::vector<std::vector<double>> out, reached;
  for (const mesh::Mesh::Place& place : places) {
    const std::vector<double> seen = reach(place.point);
    const std::vector<double> best = by_nodes(seen);
    std::vector<double>& row = out.emplace_back();
    for (std::size_t k = 0; k < reached.size(); ++k) {
      double& found = row.emplace_back(kNoWay);
      if (mesh_.polygon(place.polygon).component != mesh_.polygon(places[k].polygon).component)
        continue;
      if (visible(place.point, places[k].point))
        found = navvi_floor::distance(place.point, places[k].point);
      for (std::size_t i = 0; i < best.size(); ++i)
        found = std::min(found, best[i] + reached[k][i]);
    }
    reached.push_back(seen);
  }
  return out;
}

}  // namespace navvi_nav
