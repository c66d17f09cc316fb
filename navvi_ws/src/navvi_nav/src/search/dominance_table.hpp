#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "search/search_node.hpp"

namespace navvi_nav::search {

/// For each portal the last root from which all of it was visible: a search node with another root
/// may be dominated by it. A hash table in which a later entry replaces an earlier one.
class DominanceTable {
 public:
  struct Entry {
    std::uint32_t query = 0;
    int polygon = 0;
    int portal_right = 0;
    int portal_left = 0;
    int root = 0;
    double cost = 0.0;  ///< m, from the start
    Point root_at;

    /// True if for each point of the interval the way over this root is no longer than the way over
    /// another. If the other root costs no more, it suffices to compare at the ends: where this
    /// root is better is within a branch of a hyperbola, which is convex. If it costs more, the
    /// difference has its only minimum where the line through both roots crosses the portal.
    /// \param slack  m, of rounding
    [[nodiscard]] bool dominates(const mesh::Interval& interval, Point other, double other_cost,
                                 double slack) const {
      if (cost + distance(root_at, interval.right) >
              other_cost + distance(other, interval.right) + slack ||
          cost + distance(root_at, interval.left) >
              other_cost + distance(other, interval.left) + slack)
        return false;
      if (cost >= other_cost) return true;
      const Point to_other = other - root_at;
      const double a = cross(interval.right - root_at, to_other);
      const double b = cross(interval.left - root_at, to_other);
      return (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0) || cost + norm(to_other) <= other_cost;
    }
  };

  /// Empties the table. \param polygons  of the mesh
  void begin(std::size_t polygons) {
    while ((entries_.size() >> 1U) < polygons) {
      entries_.assign(std::max(entries_.size() * 2, std::size_t{256}), Entry{});
      shift_ = 32;
      for (std::size_t size = entries_.size(); size > 1; size >>= 1U) --shift_;
    }
    if (++query_ == 0) {
      std::fill(entries_.begin(), entries_.end(), Entry{});
      query_ = 1;
    }
  }
  /// \param node  whose interval is the whole portal
  void insert(const SearchNode& node, Point root_at) {
    entry_of(node) = {query_,    node.polygon, node.portal_right, node.portal_left, node.root,
                      node.cost, root_at};
  }
  /// The entry of another root for the node's portal; null: none.
  [[nodiscard]] const Entry* other(const SearchNode& node) {
    const Entry& entry = entry_of(node);
    const bool same = entry.query == query_ && entry.polygon == node.polygon &&
                      entry.portal_right == node.portal_right &&
                      entry.portal_left == node.portal_left;
    return same && entry.root != node.root ? &entry : nullptr;
  }

 private:
  [[nodiscard]] Entry& entry_of(const SearchNode& node) {
    const auto key = static_cast<std::uint32_t>(node.portal_right) * 0x9E3779B1U +
                     static_cast<std::uint32_t>(node.polygon) * 0x85EBCA6BU;
    return entries_[key >> shift_];
  }

  std::uint32_t query_ = 0;
  unsigned shift_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace navvi_nav::search
