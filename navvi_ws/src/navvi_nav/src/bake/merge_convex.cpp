#include "bake/merge_convex.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <navvi_types/disjoint_sets.hpp>
#include <tuple>
#include <utility>

namespace navvi_nav::bake {
namespace {

using Corner = std::array<int, 2>;
using Corners = std::vector<Corner>;

/// An edge as both its polygons see it; `from` -> `to` in the first one.
struct Shared {
  std::int64_t length2 = 0;
  Corner from{};
  Corner to{};
  int first = 0;
  int second = 0;
};

std::int64_t cross(const Corner& a, const Corner& b, const Corner& c) {
  return static_cast<std::int64_t>(b[0] - a[0]) * (c[1] - b[1]) -
         static_cast<std::int64_t>(b[1] - a[1]) * (c[0] - b[0]);
}

std::int64_t dot(const Corner& a, const Corner& b, const Corner& c) {
  return static_cast<std::int64_t>(b[0] - a[0]) * (c[0] - b[0]) +
         static_cast<std::int64_t>(b[1] - a[1]) * (c[1] - b[1]);
}

/// True if the way a, b, c turns left or goes straight on.
bool convex_at(const Corner& a, const Corner& b, const Corner& c) {
  const std::int64_t turn = cross(a, b, c);
  return turn > 0 || (turn == 0 && dot(a, b, c) > 0);
}

std::vector<Shared> shared_edges(const std::vector<mesh::GridPolygon>& polygons) {
  struct Edge {
    Corner low, high;
    bool forward;
    int polygon;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Corners& corners = polygons[i].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Corner& a = corners[k];
      const Corner& b = corners[(k + 1) % corners.size()];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<int>(i)});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.forward) < std::tie(b.low, b.high, b.forward);
  });
  std::vector<Shared> out;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const Edge& back = edges[i - 1];
    const Edge& ahead = edges[i];
    if (back.low != ahead.low || back.high != ahead.high || back.forward || !ahead.forward)
      continue;
    const std::int64_t dx = ahead.high[0] - ahead.low[0], dy = ahead.high[1] - ahead.low[1];
    out.push_back({dx * dx + dy * dy, ahead.low, ahead.high, ahead.polygon, back.polygon});
  }
  std::sort(out.begin(), out.end(), [](const Shared& a, const Shared& b) {
    return std::tie(b.length2, a.from, a.to) < std::tie(a.length2, b.from, b.to);
  });
  return out;
}

/// The corners from the one at `to` on, all around to the one at `from`. Empty if `from` -> `to` is
/// no edge.
Corners opened_at(const Corners& corners, const Corner& from, const Corner& to) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::size_t next = (k + 1) % corners.size();
    if (corners[k] != from || corners[next] != to) continue;
    Corners out(corners.begin() + static_cast<std::ptrdiff_t>(next), corners.end());
    out.insert(out.end(), corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(next));
    return out;
  }
  return {};
}

void drop_straight_corners(Corners& corners) {
  Corners kept;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Corner& before = corners[(k + corners.size() - 1) % corners.size()];
    const Corner& after = corners[(k + 1) % corners.size()];
    if (cross(before, corners[k], after) != 0) kept.push_back(corners[k]);
  }
  corners = std::move(kept);
}

/// Both together, or nothing if they are not convex or have too many corners.
Corners joined(const Corners& first, const Corners& second, const Shared& edge, int max_corners) {
  const Corners a = opened_at(first, edge.from, edge.to);
  const Corners b = opened_at(second, edge.to, edge.from);
  if (a.empty() || b.empty()) return {};
  // a runs to ... from, b runs from ... to.
  if (!convex_at(a[a.size() - 2], edge.from, b[1]) || !convex_at(b[b.size() - 2], edge.to, a[1]))
    return {};
  Corners out = a;
  out.insert(out.end(), b.begin() + 1, b.end() - 1);
  Corners turning = out;
  drop_straight_corners(turning);
  return turning.size() <= static_cast<std::size_t>(max_corners) ? out : Corners{};
}

}  // namespace

std::vector<mesh::GridPolygon> merge_convex(std::vector<mesh::GridPolygon> polygons,
                                            int max_corners) {
  navvi_types::DisjointSets<int> owners(polygons.size());
  for (const Shared& edge : shared_edges(polygons)) {
    const int first = owners.root(edge.first);
    const int second = owners.root(edge.second);
    if (first == second) continue;
    Corners& kept = polygons[static_cast<std::size_t>(first)].corners;
    Corners& gone = polygons[static_cast<std::size_t>(second)].corners;
    Corners both = joined(kept, gone, edge, max_corners);
    if (both.empty()) continue;
    kept = std::move(both);
    gone.clear();
    owners.unite(second, first);
  }
  for (mesh::GridPolygon& polygon : polygons) drop_straight_corners(polygon.corners);
  polygons.erase(
      std::remove_if(polygons.begin(), polygons.end(),
                     [](const mesh::GridPolygon& polygon) { return polygon.corners.empty(); }),
      polygons.end());
  return polygons;
}

}  // namespace navvi_nav::bake
