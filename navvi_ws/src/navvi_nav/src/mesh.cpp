#include "navvi_nav/mesh.hpp"

#include <numeric>
#include <tuple>

namespace navvi_nav {
namespace {

using Corner = std::array<int, 2>;

constexpr double kStraight = 1e-12;  // rad, above the rounding of a sum of angles

/// An edge on the line through `offset` along the primitive direction (dx, dy), from `begin` to
/// `end` in steps of that direction.
struct Edge {
  int dx = 0;
  int dy = 0;
  std::int64_t offset = 0;
  int begin = 0;
  int end = 0;
  int begin_vertex = 0;
  int end_vertex = 0;
  bool forward = true;
  int polygon = 0;
  int number = 0;  ///< within its polygon

  [[nodiscard]] auto line() const { return std::tie(dx, dy, offset); }
};

/// A link and where on the polygon's boundary it begins.
struct Crossing {
  int polygon = 0;
  int edge = 0;
  int along = 0;
  Link link;
};

int along(const Edge& edge, Corner corner) { return edge.dx != 0 ? corner[0] : corner[1]; }

Edge edge_between(Corner from, Corner to) {
  Edge edge;
  const int dx = to[0] - from[0];
  const int dy = to[1] - from[1];
  const int step = std::gcd(dx, dy);
  edge.forward = dx > 0 || (dx == 0 && dy > 0);
  edge.dx = (edge.forward ? dx : -dx) / step;
  edge.dy = (edge.forward ? dy : -dy) / step;
  edge.offset =
      static_cast<std::int64_t>(edge.dx) * from[1] - static_cast<std::int64_t>(edge.dy) * from[0];
  edge.begin = along(edge, edge.forward ? from : to);
  edge.end = along(edge, edge.forward ? to : from);
  return edge;
}

/// One vertex for each place; polygons get their corners.
Mesh place_corners(const std::vector<GridPolygon>& polygons, double cell_size) {
  std::vector<Corner> places;
  for (const GridPolygon& polygon : polygons)
    places.insert(places.end(), polygon.corners.begin(), polygon.corners.end());
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  Mesh mesh;
  mesh.vertices.reserve(places.size());
  for (const Corner& place : places)
    mesh.vertices.push_back({{place[0] * cell_size, place[1] * cell_size}, false});
  mesh.polygons.resize(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    mesh.polygons[i].corners.reserve(polygons[i].corners.size());
    for (const Corner& corner : polygons[i].corners)
      mesh.polygons[i].corners.push_back(static_cast<int>(
          std::lower_bound(places.begin(), places.end(), corner) - places.begin()));
  }
  return mesh;
}

std::vector<Edge> edges_of(const std::vector<GridPolygon>& polygons, const Mesh& mesh) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto& corners = polygons[i].corners;
    const auto& vertices = mesh.polygons[i].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t next = k + 1 < corners.size() ? k + 1 : 0;
      Edge edge = edge_between(corners[k], corners[next]);
      edge.begin_vertex = vertices[edge.forward ? k : next];
      edge.end_vertex = vertices[edge.forward ? next : k];
      edge.polygon = static_cast<int>(i);
      edge.number = static_cast<int>(k);
      edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.dx, a.dy, a.offset, a.begin, a.end, a.polygon) <
           std::tie(b.dx, b.dy, b.offset, b.begin, b.end, b.polygon);
  });
  return edges;
}

void cross_over(std::vector<Crossing>& out, const Edge& a, const Edge& b) {
  const int low = a.begin > b.begin ? a.begin_vertex : b.begin_vertex;
  const int high = a.end < b.end ? a.end_vertex : b.end_vertex;
  const Edge& ahead = a.forward ? a : b;  // its polygon lies on the left of the line
  const Edge& back = a.forward ? b : a;
  // Who leaves the left side looks to the right of the line: its left hand points along the line.
  out.push_back(
      {ahead.polygon, ahead.number, std::max(a.begin, b.begin), {back.polygon, low, high}});
  out.push_back({back.polygon, back.number, -std::min(a.end, b.end), {ahead.polygon, high, low}});
}

std::vector<Crossing> crossings_of(const std::vector<Edge>& edges) {
  std::vector<Crossing> out;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1;
         j < edges.size() && edges[j].line() == edges[i].line() && edges[j].begin < edges[i].end;
         ++j) {
      if (edges[i].forward != edges[j].forward) cross_over(out, edges[i], edges[j]);
    }
  }
  std::sort(out.begin(), out.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.polygon, a.edge, a.along) < std::tie(b.polygon, b.edge, b.along);
  });
  return out;
}

/// Gives the polygon its links, and corners where they end.
void split_edges(Polygon& polygon, const Crossing* first, const Crossing* last) {
  std::vector<int> corners;
  corners.reserve(polygon.corners.size());
  const auto add = [&corners](int vertex) {
    if (corners.empty() || (corners.back() != vertex && corners.front() != vertex))
      corners.push_back(vertex);
  };
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    add(polygon.corners[k]);
    for (; first != last && first->edge == static_cast<int>(k); ++first) {
      add(first->link.right);
      const std::size_t next = k + 1 < polygon.corners.size() ? k + 1 : 0;
      if (first->link.left != polygon.corners[next]) add(first->link.left);
      polygon.links.push_back(first->link);
    }
  }
  polygon.corners = std::move(corners);
}

/// A polygon's corner: which polygon, and the how manyth.
struct Wedge {
  int polygon = 0;
  std::size_t corner = 0;
};

/// Where polygons meet in a point and nothing else joins them, each group gets a vertex of its own:
/// a path can not pass there, and what is known of a vertex must not pass there either.
void split_pinches(Mesh& mesh) {
  std::vector<std::vector<Wedge>> wedges(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    for (std::size_t k = 0; k < mesh.polygons[i].corners.size(); ++k)
      wedges[static_cast<std::size_t>(mesh.polygons[i].corners[k])].push_back(
          {static_cast<int>(i), k});
  }
  std::vector<int> group;
  for (std::size_t vertex = 0; vertex < wedges.size(); ++vertex) {
    const std::vector<Wedge>& around = wedges[vertex];
    const int here = static_cast<int>(vertex);
    group.assign(around.size(), 0);
    std::iota(group.begin(), group.end(), 0);
    for (std::size_t i = 0; i < around.size(); ++i) {
      for (const Link& link : mesh.polygon(around[i].polygon).links) {
        if (link.right != here && link.left != here) continue;
        const auto joined = std::find_if(around.begin(), around.end(), [&](const Wedge& wedge) {
          return wedge.polygon == link.to;
        });
        const int from = group[static_cast<std::size_t>(joined - around.begin())];
        std::replace(group.begin(), group.end(), from, int{group[i]});
      }
    }
    for (std::size_t i = 1; i < around.size(); ++i) {
      if (group[i] == group[0]) continue;
      const int own = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back({mesh.at(here), false});
      for (std::size_t j = around.size(); j-- > i;) {
        if (group[j] != group[i]) continue;
        Polygon& polygon = mesh.polygons[static_cast<std::size_t>(around[j].polygon)];
        polygon.corners[around[j].corner] = own;
        for (Link& link : polygon.links) {
          if (link.right == here) link.right = own;
          if (link.left == here) link.left = own;
        }
        group[j] = group[0];
      }
    }
  }
}

/// The angle at a corner inside a polygon, rad.
double angle_at(Point before, Point corner, Point after) {
  const Point a = after - corner;
  const Point b = before - corner;
  return std::abs(std::atan2(cross(a, b), dot(a, b)));  // a straight one may come as -pi
}

void find_corners(Mesh& mesh) {
  std::vector<double> free(mesh.vertices.size(), 0.0);
  std::vector<char> walled(mesh.vertices.size(), 0);
  for (const Polygon& polygon : mesh.polygons) {
    const std::size_t count = polygon.corners.size();
    std::size_t link = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto before = static_cast<std::size_t>(polygon.corners[(k + count - 1) % count]);
      const auto here = static_cast<std::size_t>(polygon.corners[k]);
      const auto after = static_cast<std::size_t>(polygon.corners[(k + 1) % count]);
      free[here] +=
          angle_at(mesh.vertices[before].at, mesh.vertices[here].at, mesh.vertices[after].at);
      if (link < polygon.links.size() && polygon.links[link].right == static_cast<int>(here)) {
        ++link;
      } else {
        walled[here] = walled[after] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i].corner = walled[i] != 0 && free[i] > M_PI + kStraight;
}

void number_parts(Mesh& mesh) {
  std::vector<int> waiting;
  int count = 0;
  for (Polygon& polygon : mesh.polygons) polygon.part = -1;
  for (std::size_t seed = 0; seed < mesh.polygons.size(); ++seed) {
    if (mesh.polygons[seed].part >= 0) continue;
    mesh.polygons[seed].part = count;
    waiting.push_back(static_cast<int>(seed));
    while (!waiting.empty()) {
      const auto at = static_cast<std::size_t>(waiting.back());
      waiting.pop_back();
      for (const Link& link : mesh.polygons[at].links) {
        Polygon& next = mesh.polygons[static_cast<std::size_t>(link.to)];
        if (next.part >= 0) continue;
        next.part = count;
        waiting.push_back(link.to);
      }
    }
    ++count;
  }
}

}  // namespace

std::vector<Point> Mesh::outline(int index) const {
  std::vector<Point> out;
  out.reserve(polygon(index).corners.size());
  for (const int corner : polygon(index).corners) out.push_back(at(corner));
  return out;
}

Point Mesh::centroid(int index) const {
  const auto& corners = polygon(index).corners;
  const Point origin = at(corners[0]);
  Point sum;
  double area = 0.0;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Point a = at(corners[k - 1]) - origin;
    const Point b = at(corners[k]) - origin;
    const double twice = cross(a, b);
    sum = sum + twice * (a + b);
    area += twice;
  }
  return area > 0.0 ? origin + (1.0 / (3.0 * area)) * sum : origin;
}

std::optional<Mesh::Place> Mesh::locate(Point point, double within, std::optional<int> part) const {
  std::optional<Place> best;
  double best_distance = within;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i].corners.empty() || (part && polygons[i].part != *part)) continue;
    Point low = at(polygons[i].corners[0]);
    Point high = low;
    for (const int corner : polygons[i].corners) {
      low = {std::min(low.x, at(corner).x), std::min(low.y, at(corner).y)};
      high = {std::max(high.x, at(corner).x), std::max(high.y, at(corner).y)};
    }
    const double aside =
        std::max({low.x - point.x, point.x - high.x, low.y - point.y, point.y - high.y});
    if (!(aside <= best_distance)) continue;
    const Point candidate = nearest_in_convex(point, outline(static_cast<int>(i)));
    const double away = distance(candidate, point);
    if (away > best_distance || (best && away == best_distance)) continue;
    best = Place{static_cast<int>(i), candidate};
    best_distance = away;
    if (away == 0.0) break;
  }
  return best;
}

Mesh join(const std::vector<GridPolygon>& polygons, double cell_size) {
  Mesh mesh = place_corners(polygons, cell_size);
  const std::vector<Crossing> crossings = crossings_of(edges_of(polygons, mesh));
  const Crossing* first = crossings.data();
  const Crossing* const end = first + crossings.size();
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const Crossing* last = first;
    while (last != end && last->polygon == static_cast<int>(i)) ++last;
    split_edges(mesh.polygons[i], first, last);
    first = last;
  }
  split_pinches(mesh);
  find_corners(mesh);
  number_parts(mesh);
  return mesh;
}

}  // namespace navvi_nav
