#include "navvi_nav/landmarks.hpp"

#include <limits>
#include <queue>
#include <tuple>

namespace navvi_nav {
namespace {

constexpr float kNoWay = std::numeric_limits<float>::infinity();
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();  // a difference from it: none

}  // namespace

void Landmarks::measure(const Mesh& mesh, const Mesh::Place& somewhere, Tangents& tangents) {
  Ways none;
  none.fill(kNoWay);
  // The first landmark is as far from anywhere as it gets, each further one from those before.
  places_[0] = somewhere;
  sees_.resize(mesh.polygons.size());
  turning_.assign(mesh.vertices.size(), none);
  places_[0] = turn_everywhere(mesh, 0, tangents).place;
  turning_.assign(mesh.vertices.size(), none);
  sees_.assign(mesh.polygons.size(), {});
  for (std::size_t k = 0; k < kCount; ++k) {
    const Far next = turn_everywhere(mesh, k, tangents);
    if (k + 1 < kCount) places_[k + 1] = next.place;
  }
  // A way may end at a corner that it could not turn round: each has to look about once more.
  none.fill(kUnknown);
  ways_.assign(mesh.vertices.size(), none);
  std::vector<char> done(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    for (const int corner : mesh.polygons[i].corners) {
      const auto vertex = static_cast<std::size_t>(corner);
      if (done[vertex] != 0 || !mesh.vertices[vertex].corner) continue;
      done[vertex] = 1;
      const auto& seen = sight_.look(mesh, {static_cast<int>(i), mesh.at(corner)});
      ways_[vertex] = ways_from(sight_.around(), seen);
    }
  }
  forget_pinches(mesh);
  known_ = true;
}

/// Where polygons meet in a point only, holes can change which of them has which of its vertices.
/// Only one side can be a corner, but the other may come by its number.
void Landmarks::forget_pinches(const Mesh& mesh) {
  std::vector<int> vertices;
  for (const Polygon& polygon : mesh.polygons)
    vertices.insert(vertices.end(), polygon.corners.begin(), polygon.corners.end());
  const auto key = [&mesh](int vertex) {
    return std::make_tuple(mesh.at(vertex).x, mesh.at(vertex).y, vertex);
  };
  std::sort(vertices.begin(), vertices.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const int a = vertices[i - 1];
    const int b = vertices[i];
    if (a == b || !(mesh.at(a) == mesh.at(b))) continue;
    ways_[static_cast<std::size_t>(a)].fill(kUnknown);
    ways_[static_cast<std::size_t>(b)].fill(kUnknown);
  }
}

/// Dijkstra's search from one landmark. \returns the corner that is farthest from all landmarks up
/// to this one
Landmarks::Far Landmarks::turn_everywhere(const Mesh& mesh, std::size_t landmark,
                                          Tangents& tangents) {
  struct Entry {
    double way;
    int vertex;
    bool operator<(const Entry& other) const { return way > other.way; }
  };
  std::priority_queue<Entry> open;
  std::vector<double> ways(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  const auto reach = [&](int vertex, double way) {
    double& known = ways[static_cast<std::size_t>(vertex)];
    if (way >= known) return;
    known = way;
    open.push({way, vertex});
  };
  Far out;
  out.place = places_[landmark];
  for (const Sight::Corner& corner : sight_.look(mesh, places_[landmark])) {
    tangents.meet(corner);
    reach(corner.vertex, corner.away);
  }
  for (std::size_t i = 0; i < sees_.size(); ++i)
    sees_[i][landmark] = sight_.swept(static_cast<int>(i));
  while (!open.empty()) {
    const Entry entry = open.top();
    open.pop();
    const auto vertex = static_cast<std::size_t>(entry.vertex);
    if (entry.way > ways[vertex]) continue;
    Ways& turning = turning_[vertex];
    turning[landmark] = static_cast<float>(entry.way);
    const auto nearest = static_cast<double>(*std::min_element(turning.begin(), turning.end()));
    // Inside a polygon, so that the landmark is seen only through that polygon.
    if (nearest > out.way) {
      const int polygon = tangents.polygon_of(entry.vertex);
      out = {{polygon, mesh.centroid(polygon)}, nearest};
    }
    for (const Tangents::Edge& edge : tangents.from(entry.vertex, 0))
      reach(edge.vertex(), entry.way + distance(mesh.at(entry.vertex), mesh.at(edge.vertex())));
  }
  return out;
}

/// Of a place. A landmark that it may see is left out: the way there need not turn.
Landmarks::Ways Landmarks::ways_from(const std::vector<int>& around,
                                     const std::vector<Sight::Corner>& seen) const {
  Ways out;
  out.fill(kNoWay);
  for (const Sight::Corner& corner : seen) {
    const Ways& turning = turning_[static_cast<std::size_t>(corner.vertex)];
    const auto away = static_cast<float>(corner.away);
    for (std::size_t k = 0; k < kCount; ++k) out[k] = std::min(out[k], away + turning[k]);
  }
  for (std::size_t k = 0; k < kCount; ++k) {
    bool may_see = false;
    for (const int polygon : around)
      may_see = may_see || sees_[static_cast<std::size_t>(polygon)][k];
    if (out[k] == kNoWay || may_see) out[k] = kUnknown;
  }
  return out;
}

}  // namespace navvi_nav
