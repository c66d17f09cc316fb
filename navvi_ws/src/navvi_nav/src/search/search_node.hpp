#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::search {

/// A search node of Polyanya: the interval of a portal that is visible from a root, which is a
/// corner or the start, and the polygon behind that portal. The interval is given by the directions
/// from the root to its ends.
struct SearchNode {
  double cost;  ///< m, from the start to the root
  Point right;  ///< direction of the right border, from the root
  Point left;
  int root;          ///< vertex, or one beyond the last: the start
  int polygon;       ///< that is entered; -1: the goal is visible
  int portal_right;  ///< vertices, as seen on the way
  int portal_left;
  bool right_end;  ///< the right border runs through the portal's right vertex
  bool left_end;

  /// The visible part of the portal. \param root_at, portal_right_at, portal_left_at  m
  [[nodiscard]] mesh::Interval interval(Point root_at, Point portal_right_at,
                                        Point portal_left_at) const {
    return {
        right_end ? portal_right_at
                  : intersection(right, root_at, portal_right_at, portal_left_at, portal_right_at),
        left_end ? portal_left_at
                 : intersection(left, root_at, portal_right_at, portal_left_at, portal_left_at)};
  }

  /// The heuristic of Polyanya: m, from the root through the interval to the goal if nothing else
  /// is in the way. A goal on the root's side of the portal is mirrored at it, which keeps the
  /// length. \param turn  m, price of a turn
  [[nodiscard]] double heuristic(Point root_at, Point portal_right_at, Point portal_left_at,
                                 Point goal, double turn) const {
    const Point edge = portal_left_at - portal_right_at;
    Point target = goal - portal_right_at;
    const double inside = cross(edge, target);
    if (inside > 0.0) {
      const double k = 2.0 * inside / dot(edge, edge);
      target = target + Point{k * edge.y, -k * edge.x};
    }
    target = target + (portal_right_at - root_at);
    const bool on_end = root == portal_right || root == portal_left;
    const bool over_right = !on_end && cross(right, target) < 0.0;
    const bool over_left = !on_end && !over_right && cross(left, target) > 0.0;
    if (!over_right && !over_left) return norm(target);
    const Point border = over_right ? right : left;
    const Point x =
        (over_right ? right_end : left_end)
            ? border
            : intersection(border, {}, portal_right_at - root_at, portal_left_at - root_at, {});
    return norm(x) + distance(x, target) + turn;
  }

 private:
  /// Where a border crosses the line of the portal. \param otherwise  if they are parallel
  static Point intersection(Point border, Point root_at, Point portal_right_at,
                            Point portal_left_at, Point otherwise) {
    const auto extent = [](Point a) { return std::abs(a.x) + std::abs(a.y); };
    const Point edge = portal_left_at - portal_right_at;
    const double across = cross(border, edge);
    if (std::abs(across) < 1e-9 * extent(border) * extent(edge)) return otherwise;
    return root_at + (cross(portal_right_at - root_at, edge) / across) * border;
  }
};

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

/// A priority queue, the least key first: a heap with four children a node. The entry pushed last
/// is often the least, so the least one pushed since the last pop from the heap is kept outside of
/// it. Keeps its memory.
template <typename Key, typename Item>
class OpenList {
 public:
  struct Entry {
    Key key;
    Item item;
  };

  void clear() {
    heap_.clear();
    has_first_ = false;
  }
  [[nodiscard]] bool empty() const { return heap_.empty() && !has_first_; }
  void push(Key key, Item item) {
    Entry entry{key, item};
    if (!std::exchange(has_first_, true)) {
      first_ = entry;
      return;
    }
    if (entry.key < first_.key) std::swap(entry, first_);
    sift_up(entry);
  }
  /// Removes the least entry. The list must not be empty.
  Entry pop() {
    if (has_first_ && (heap_.empty() || first_.key <= heap_[0].key)) {
      has_first_ = false;
      return first_;
    }
    const Entry least = heap_[0];
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sift_down(last);
    return least;
  }

 private:
  void sift_up(const Entry& entry) {
    std::size_t i = heap_.size();
    heap_.push_back(entry);
    while (i > 0) {
      const std::size_t up = (i - 1) / 4;
      if (heap_[up].key <= entry.key) break;
      heap_[i] = heap_[up];
      i = up;
    }
    heap_[i] = entry;
  }
  void sift_down(const Entry& entry) {
    const std::size_t count = heap_.size();
    std::size_t i = 0;
    while (4 * i + 1 < count) {
      std::size_t least = 4 * i + 1;
      const std::size_t end = std::min(least + 4, count);
      for (std::size_t k = least + 1; k < end; ++k) {
        if (heap_[k].key < heap_[least].key) least = k;
      }
      if (heap_[least].key >= entry.key) break;
      heap_[i] = heap_[least];
      i = least;
    }
    heap_[i] = entry;
  }

  std::vector<Entry> heap_;
  Entry first_{};
  bool has_first_ = false;
};

}  // namespace navvi_nav::search
