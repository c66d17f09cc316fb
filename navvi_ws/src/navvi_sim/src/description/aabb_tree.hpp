#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace navvi_sim {

/// Boxes by where they are: a binary tree of bounds, split at the median along the longest side.
class AabbTree {
 public:
  AabbTree() = default;
  explicit AabbTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// Visits the boxes that may matter, nearer halves of the tree first.
  /// \param bound  of a box: no less for what lies within it
  /// \param limit  larger bounds are skipped; it may fall while visiting
  /// \param visit  gets the index of a box; its own bound is not computed
  template <typename Bound, typename Limit, typename Visit>
  void search(Bound bound, Limit limit, Visit visit) const {
    if (nodes_.empty() || bound(nodes_[0].box) > limit()) return;
    std::array<std::pair<double, std::uint32_t>, 64> open;  // a median split is never that deep
    std::size_t count = 0;
    open[count++] = {0.0, 0};
    while (count > 0) {
      const auto [least, index] = open[--count];
      if (least > limit()) continue;
      const Node& node = nodes_[index];
      if (node.count > 0) {
        for (std::uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
        continue;
      }
      std::pair<double, std::uint32_t> near{bound(nodes_[index + 1].box), index + 1};
      std::pair<double, std::uint32_t> far{bound(nodes_[node.first].box), node.first};
      if (far.first < near.first) std::swap(near, far);
      if (far.first <= limit()) open[count++] = far;
      if (near.first <= limit()) open[count++] = near;
    }
  }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first;  ///< of a leaf: in order_; else the second child, the first one is next
    std::uint32_t count;  ///< of a leaf; else 0
  };

  void build(const std::vector<Eigen::AlignedBox3d>& boxes, std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace navvi_sim
