#include "description/aabb_tree.hpp"

#include <algorithm>
#include <numeric>

namespace navvi_sim {

constexpr std::uint32_t kLeaf = 4;  // boxes, the most in a leaf

AabbTree::AabbTree(const std::vector<Eigen::AlignedBox3d>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
}

void AabbTree::build(const std::vector<Eigen::AlignedBox3d>& boxes, std::uint32_t begin,
                     std::uint32_t end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, begin, end - begin});
  Eigen::AlignedBox3d centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    nodes_[node].box.extend(boxes[order_[i]]);
    centres.extend(boxes[order_[i]].center());
  }
  if (end - begin <= kLeaf) return;
  Eigen::Index axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double at = boxes[a].center()[axis], bt = boxes[b].center()[axis];
                     return at != bt ? at < bt : a < b;
                   });
  build(boxes, begin, middle);
  nodes_[node].count = 0;
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, middle, end);
}

}  // namespace navvi_sim
