#include "traffic/block_index.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_sim::traffic {
namespace {

constexpr double kCell = 2.0;  // m

std::uint64_t key(std::int64_t x, std::int64_t y) {
  return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFu);
}

/// Calls `visit` with the key of each cell that the bounds touch.
template <typename Visit>
void for_each_cell(const Eigen::AlignedBox2d& bounds, Visit visit) {
  const auto cell = [](double value) {
    return static_cast<std::int64_t>(std::floor(value / kCell));
  };
  for (std::int64_t x = cell(bounds.min().x()); x <= cell(bounds.max().x()); ++x)
    for (std::int64_t y = cell(bounds.min().y()); y <= cell(bounds.max().y()); ++y)
      visit(key(x, y));
}

}  // namespace

Eigen::AlignedBox2d bounds_of(const Polygon& polygon) {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& corner : polygon) bounds.extend(corner);
  return bounds;
}

BlockIndex::BlockIndex(const std::vector<Polygon>& polygons, double gap)
    : polygons_(polygons), gap_(gap) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(0.5 * gap);
  bounds_.reserve(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    bounds_.push_back(bounds_of(polygons[i]));
    if (bounds_[i].isEmpty()) continue;
    bounds_[i] = {bounds_[i].min() - reach, bounds_[i].max() + reach};
    for_each_cell(bounds_[i], [&](std::uint64_t cell) { entries_.push_back({cell, i}); });
  }
  std::sort(entries_.begin(), entries_.end());
}

std::vector<BlockIndex::Pair> BlockIndex::pairs(
    const std::function<bool(const Pair&)>& wanted) const {
  std::vector<Pair> found;
  for (std::size_t begin = 0; begin < entries_.size();) {
    std::size_t end = begin + 1;
    while (end < entries_.size() && entries_[end].cell == entries_[begin].cell) ++end;
    for (std::size_t a = begin; a < end; ++a)
      for (std::size_t b = a + 1; b < end; ++b) {
        const Pair pair{entries_[a].polygon, entries_[b].polygon};
        if (wanted(pair) && bounds_[pair.first].intersects(bounds_[pair.second]))
          found.push_back(pair);
      }
    begin = end;
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  found.erase(std::remove_if(found.begin(), found.end(),
                             [&](const Pair& pair) {
                               return !overlap(polygons_[pair.first], polygons_[pair.second], gap_);
                             }),
              found.end());
  return found;
}

std::vector<std::size_t> BlockIndex::touching(const Polygon& other) const {
  std::vector<std::size_t> found;
  const Eigen::AlignedBox2d bounds = bounds_of(other);
  if (entries_.empty() || bounds.isEmpty()) return found;
  for_each_cell(bounds, [&](std::uint64_t cell) {
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{cell, 0});
    for (; entry != entries_.end() && entry->cell == cell; ++entry)
      if (bounds_[entry->polygon].intersects(bounds)) found.push_back(entry->polygon);
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  found.erase(
      std::remove_if(found.begin(), found.end(),
                     [&](std::size_t polygon) { return !overlap(polygons_[polygon], other, 0.0); }),
      found.end());
  return found;
}

}  // namespace navvi_sim::traffic
