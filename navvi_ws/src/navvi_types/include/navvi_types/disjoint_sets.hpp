#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace navvi_types {

/// Nodes in sets that can be united (Galler and Fischer, 1964). \tparam Node  a whole number
template <typename Node>
class DisjointSets {
 public:
  DisjointSets() = default;
  /// Nodes from 0 on, each in a set of its own.
  explicit DisjointSets(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), Node{0});
  }

  /// Makes room; nodes are in no set until add().
  void grow(std::size_t count) { parents_.resize(count, kNone); }
  void add(Node node) { parent(node) = node; }
  void remove(Node node) { parent(node) = kNone; }
  [[nodiscard]] bool has(Node node) const {
    return parents_[static_cast<std::size_t>(node)] != kNone;
  }
  /// The root of b's set becomes that of both. \return whether they were two
  bool unite(Node a, Node b) {
    a = root(a);
    b = root(b);
    parent(a) = b;
    return a != b;
  }
  /// The same for all nodes of a set.
  Node root(Node node) {
    while (parent(node) != node) node = parent(node) = parent(parent(node));
    return node;
  }

 private:
  static constexpr Node kNone = static_cast<Node>(-1);

  Node& parent(Node node) { return parents_[static_cast<std::size_t>(node)]; }

  std::vector<Node> parents_;
};

}  // namespace navvi_types
