#include "mesh/edge_matcher.hpp"

#include <algorithm>

namespace navvi_nav::mesh {
namespace {

std::uint64_t hash_of(const HalfPlane& line) {
  std::uint64_t out = static_cast<std::uint64_t>(line.a) * 0x9E3779B97F4A7C15ULL;
  out = (out ^ (out >> 32U)) + static_cast<std::uint64_t>(line.b) * 0xC2B2AE3D27D4EB4FULL;
  out = (out ^ (out >> 29U)) + static_cast<std::uint64_t>(line.c) * 0x165667B19E3779F9ULL;
  return out ^ (out >> 32U);
}

/// With the half-plane on the left, its border leads along (b, -a).
bool leads_ahead(const HalfPlane& line) { return line.b > 0 || (line.b == 0 && line.a < 0); }

}  // namespace

double along(const Side& side, Point at) {
  const HalfPlane& line = side.line;
  if (std::abs(line.b) >= std::abs(line.a)) return line.b > 0 ? at.x : -at.x;
  return line.a < 0 ? at.y : -at.y;
}

void EdgeMatcher::clear() {
  entries_.clear();
  keys_.clear();
}

void EdgeMatcher::add(const std::vector<Side>& sides, int number, int polygon, bool fresh,
                      const std::vector<Vertex>& vertices) {
  const auto k = static_cast<std::size_t>(number);
  const int begin = sides[k].begin;
  const int end = sides[k + 1 < sides.size() ? k + 1 : 0].begin;
  Entry entry;
  entry.ahead = leads_ahead(sides[k].line);
  entry.line = entry.ahead ? sides[k].line : sides[k].line.opposite();
  entry.low_vertex = entry.ahead ? begin : end;
  entry.high_vertex = entry.ahead ? end : begin;
  const Side canonical{entry.line, 0, 0};
  entry.low = along(canonical, vertices[static_cast<std::size_t>(entry.low_vertex)].at);
  entry.high = along(canonical, vertices[static_cast<std::size_t>(entry.high_vertex)].at);
  entry.polygon = polygon;
  entry.side = number;
  entry.fresh = fresh;
  keys_.push_back({hash_of(entry.line), entry.low, entries_.size()});
  entries_.push_back(entry);
}

void EdgeMatcher::match(std::vector<SidePortal>& out) {
  std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) {
    return a.line != b.line ? a.line < b.line : a.low < b.low;
  });
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const Entry& a = entries_[keys_[i].entry];
    for (std::size_t j = i + 1;
         j < keys_.size() && keys_[j].line == keys_[i].line && keys_[j].low < a.high; ++j) {
      const Entry& b = entries_[keys_[j].entry];
      if (a.ahead == b.ahead || !(a.fresh || b.fresh) || !(a.line == b.line)) continue;
      const int low = a.low > b.low ? a.low_vertex : b.low_vertex;
      const int high = a.high < b.high ? a.high_vertex : b.high_vertex;
      const Entry& ahead = a.ahead ? a : b;
      const Entry& back = a.ahead ? b : a;
      // Leaving the left side of the line means looking right: left is then along the line.
      out.push_back({ahead.polygon, ahead.side, std::max(a.low, b.low), {back.polygon, low, high}});
      out.push_back(
          {back.polygon, back.side, -std::min(a.high, b.high), {ahead.polygon, high, low}});
    }
  }
}

void bound(Polygon& polygon, const std::vector<Side>& sides, const SidePortal* first,
           const SidePortal* last) {
  polygon.corners.clear();
  polygon.portals.clear();
  for (std::size_t k = 0; k < sides.size(); ++k) {
    polygon.corners.push_back(sides[k].begin);
    const int end = sides[k + 1 < sides.size() ? k + 1 : 0].begin;
    for (; first != last && first->side == static_cast<int>(k); ++first) {
      if (first->portal.right != polygon.corners.back())
        polygon.corners.push_back(first->portal.right);
      if (first->portal.left != end) polygon.corners.push_back(first->portal.left);
      polygon.portals.push_back(first->portal);
    }
  }
}

}  // namespace navvi_nav::mesh
