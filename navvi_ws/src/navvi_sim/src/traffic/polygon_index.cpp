#include "traffic/polygon_index.hpp"

#include <algorithm>

namespace navvi_sim::traffic {
namespace {

Eigen::AlignedBox3d bounds_of(const Polygon& polygon, double margin) {
  Eigen::AlignedBox3d bounds;
  const Eigen::Vector3d reach(margin, margin, 0.0);
  for (const Eigen::Vector2d& corner : polygon) {
    const Eigen::Vector3d at(corner.x(), corner.y(), 0.0);
    bounds.extend(at - reach).extend(at + reach);
  }
  return bounds;
}

/// Calls `visit` with the index of each box of the tree that may meet `bounds`.
template <typename Visit>
void for_each_near(const AabbTree& tree, const Eigen::AlignedBox3d& bounds, Visit visit) {
  tree.search([&](const Eigen::AlignedBox3d& box) { return box.intersects(bounds) ? 0.0 : 1.0; },
              [] { return 0.0; }, visit);
}

}  // namespace

PolygonIndex::PolygonIndex(const std::vector<Polygon>& polygons, double gap)
    : polygons_(polygons), gap_(gap) {
  for (const Polygon& polygon : polygons) bounds_.push_back(bounds_of(polygon, 0.5 * gap));
  tree_ = AabbTree(bounds_);
}

std::vector<PolygonIndex::Pair> PolygonIndex::pairs(
    const std::function<bool(const Pair&)>& wanted) const {
  std::vector<Pair> found;
  for (std::size_t a = 0; a < bounds_.size(); ++a)
    for_each_near(tree_, bounds_[a], [&](std::size_t b) {
      if (b > a && bounds_[a].intersects(bounds_[b]) && wanted({a, b}) &&
          overlap(polygons_[a], polygons_[b], gap_))
        found.emplace_back(a, b);
    });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::size_t> PolygonIndex::touching(const Polygon& other) const {
  std::vector<std::size_t> found;
  const Eigen::AlignedBox3d bounds = bounds_of(other, 0.0);
  for_each_near(tree_, bounds, [&](std::size_t i) {
    if (bounds_[i].intersects(bounds) && overlap(polygons_[i], other, 0.0)) found.push_back(i);
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace navvi_sim::traffic
