#include "navvi_nav/mesh.hpp"

#include <numeric>
#include <tuple>

namespace navvi_nav {
namespace {

using Corner = std::array<int, 2>;

/// An edge on the line through `offset` along the primitive direction (dx, dy), from `begin` to
/// `end` in steps of that direction.
struct Edge {
  int dx = 0;
  int dy = 0;
  std::int64_t offset = 0;
  int begin = 0;
  int end = 0;
  bool forward = true;
  int triangle = 0;

  [[nodiscard]] auto line() const { return std::tie(dx, dy, offset); }
};

int along(const Edge& edge, Corner corner) { return edge.dx != 0 ? corner[0] : corner[1]; }

Edge edge_between(Corner from, Corner to, int triangle) {
  Edge edge;
  const int dx = to[0] - from[0];
  const int dy = to[1] - from[1];
  const int step = std::gcd(dx, dy);
  edge.forward = dx > 0 || (dx == 0 && dy > 0);
  edge.dx = (edge.forward ? dx : -dx) / step;
  edge.dy = (edge.forward ? dy : -dy) / step;
  edge.offset =
      static_cast<std::int64_t>(edge.dx) * from[1] - static_cast<std::int64_t>(edge.dy) * from[0];
  const int a = along(edge, from);
  const int b = along(edge, to);
  edge.begin = std::min(a, b);
  edge.end = std::max(a, b);
  edge.triangle = triangle;
  return edge;
}

/// The point of the edge's line whose leading coordinate is `at`, in cells.
Point point_at(const Edge& edge, int at) {
  if (edge.dx == 0) return {-static_cast<double>(edge.offset) / edge.dy, static_cast<double>(at)};
  return {static_cast<double>(at),
          (static_cast<double>(edge.offset) + static_cast<double>(edge.dy) * at) / edge.dx};
}

std::vector<Edge> edges_of(const std::vector<GridTriangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& corners = triangles[i].corners;
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(edge_between(corners[k], corners[(k + 1) % 3], static_cast<int>(i)));
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.dx, a.dy, a.offset, a.begin, a.end, a.triangle) <
           std::tie(b.dx, b.dy, b.offset, b.begin, b.end, b.triangle);
  });
  return edges;
}

void link(Mesh& mesh, const Edge& a, const Edge& b, double cell_size) {
  const Point low = cell_size * point_at(a, std::max(a.begin, b.begin));
  const Point high = cell_size * point_at(a, std::min(a.end, b.end));
  const Edge& ahead = a.forward ? a : b;  // its triangle lies on the left of the line
  const Edge& back = a.forward ? b : a;
  // Who leaves the left side looks to the right of the line: its left hand points along the line.
  mesh.triangles[static_cast<std::size_t>(ahead.triangle)].links.push_back(
      {back.triangle, high, low});
  mesh.triangles[static_cast<std::size_t>(back.triangle)].links.push_back(
      {ahead.triangle, low, high});
}

void number_parts(Mesh& mesh) {
  std::vector<int> waiting;
  int count = 0;
  for (Triangle& triangle : mesh.triangles) triangle.part = -1;
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (mesh.triangles[seed].part >= 0) continue;
    mesh.triangles[seed].part = count;
    waiting.push_back(static_cast<int>(seed));
    while (!waiting.empty()) {
      const auto at = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      for (const Link& link : mesh.triangles[at].links) {
        Triangle& next = mesh.triangles[static_cast<std::size_t>(link.to)];
        if (next.part >= 0) continue;
        next.part = count;
        waiting.push_back(link.to);
      }
    }
    ++count;
  }
}

}  // namespace

Point Triangle::centroid() const { return (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]); }

bool Triangle::contains(Point point) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Point a = corners[k];
    const Point b = corners[(k + 1) % 3];
    if (cross(b - a, point - a) < 0.0) return false;
  }
  return true;
}

Point Triangle::nearest(Point point) const {
  if (contains(point)) return point;
  Point best = corners[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Point candidate = nearest_on_segment(point, corners[k], corners[(k + 1) % 3]);
    if (distance(candidate, point) < distance(best, point)) best = candidate;
  }
  return best;
}

std::optional<Mesh::Place> Mesh::locate(Point point, double within, std::optional<int> part) const {
  std::optional<Place> best;
  double best_distance = within;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (part && triangles[i].part != *part) continue;
    const auto& corners = triangles[i].corners;
    const auto [x0, x1] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [y0, y1] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const double aside = std::max({x0 - point.x, point.x - x1, y0 - point.y, point.y - y1});
    if (!(aside <= best_distance)) continue;
    const Point candidate = triangles[i].nearest(point);
    const double away = distance(candidate, point);
    if (away > best_distance || (best && away == best_distance)) continue;
    best = Place{static_cast<int>(i), candidate};
    best_distance = away;
    if (away == 0.0) break;
  }
  return best;
}

Mesh join(const std::vector<GridTriangle>& triangles, double cell_size) {
  Mesh mesh;
  mesh.triangles.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& corner = triangles[i].corners[k];
      mesh.triangles[i].corners[k] = {corner[0] * cell_size, corner[1] * cell_size};
    }
  }
  const std::vector<Edge> edges = edges_of(triangles);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1;
         j < edges.size() && edges[j].line() == edges[i].line() && edges[j].begin < edges[i].end;
         ++j) {
      if (edges[i].forward != edges[j].forward) link(mesh, edges[i], edges[j], cell_size);
    }
  }
  number_parts(mesh);
  return mesh;
}

}  // namespace navvi_nav
