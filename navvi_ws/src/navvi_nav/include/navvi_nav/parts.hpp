#pragma once

#include <vector>

#include "navvi_nav/mesh.hpp"

namespace navvi_nav {

/// Nodes in sets that can be united.
class Forest {
 public:
  /// Makes room; nodes are in no set until add().
  void grow(std::size_t count) { parents_.resize(count, -1); }
  void add(int node) { parents_[static_cast<std::size_t>(node)] = node; }
  void remove(int node) { parents_[static_cast<std::size_t>(node)] = -1; }
  [[nodiscard]] bool has(int node) const { return parents_[static_cast<std::size_t>(node)] >= 0; }
  void unite(int a, int b) { parents_[static_cast<std::size_t>(root(a))] = root(b); }
  /// The same for all nodes of a set.
  int root(int node);

 private:
  std::vector<int> parents_;
};

/// Keeps the polygons' parts true while the mesh changes here and there.
class Parts {
 public:
  /// A polygon that got new links.
  struct Changed {
    int polygon = 0;
    bool fresh = false;  ///< it is new, and has no part yet
    int region = 0;      ///< where: of two regions, neither touches what changed in the other
  };

  /// Numbers all anew.
  void number(Mesh& mesh);
  /// Looks at what changed alone, where that tells that no part was split or joined: around each
  /// region, the polygons of a part are still joined by what is new. Else numbers all anew.
  void update(Mesh& mesh, const std::vector<Changed>& changed);

 private:
  bool label(Mesh& mesh, const std::vector<Changed>& changed);

  /// A changed polygon that kept its part.
  struct Witness {
    int region = 0;
    int part = 0;
    int group = 0;
  };
  int next_ = 0;
  Forest groups_;  // of changed polygons that links among them join
  std::vector<Witness> witnesses_;
  std::vector<int> waiting_;
  std::vector<int> labels_;  // part of each group
};

}  // namespace navvi_nav
