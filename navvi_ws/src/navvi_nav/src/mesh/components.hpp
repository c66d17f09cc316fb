#pragma once

#include <array>
#include <navvi_types/disjoint_sets.hpp>
#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::mesh {

/// Keeps the polygons' component numbers up to date while parts of the mesh change.
class Components {
 public:
  /// A polygon that got new portals.
  struct Changed {
    int polygon = 0;
    bool fresh = false;  ///< it is new and has no component yet
    int region = 0;      ///< polygons that changed in different regions do not touch
  };

  /// Numbers all again.
  void number(Mesh& mesh);
  /// Visits only the changed polygons if these show that no component was split or joined: around
  /// each region, the polygons of a component are still joined by new ones. Else numbers all again.
  void update(Mesh& mesh, const std::vector<Changed>& changed);

 private:
  bool label(Mesh& mesh, const std::vector<Changed>& changed);

  int next_ = 0;
  navvi_types::DisjointSets<int> groups_;  // of changed polygons that portals among them join
  std::vector<std::array<int, 3>> kept_;  // region, component and group where a component was kept
  std::vector<int> waiting_;
  std::vector<int> labels_;  // component of each group
};

}  // namespace navvi_nav::mesh
