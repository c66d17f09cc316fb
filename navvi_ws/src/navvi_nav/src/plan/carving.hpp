#pragma once

#include <vector>

#include "geometry.hpp"
#include "mesh/cut_mesh.hpp"

namespace navvi_nav::plan {

/// When a moving thing's hole follows it (R-NAV-5).
struct CarvingRules {
  double room = 0.35;    ///< m, of a hole beyond the cylinder's radius
  double changed = 0.0;  ///< fraction of the carved area that must have changed at all
};

/// The moving things that have holes in a mesh, identified by their ids.
class Carving {
 public:
  explicit Carving(const CarvingRules& rules) : rules_(rules) {}

  /// Makes the holes those of `cylinders`. \returns polygons of the floor that were cut anew
  int carve(mesh::CutMesh& mesh, const std::vector<Cylinder>& cylinders);
  /// Takes all holes out of the mesh, until repeat().
  void lift(mesh::CutMesh& mesh);
  /// Makes the same holes in a mesh without any.
  void repeat(mesh::CutMesh& mesh);
  /// As carved, by id.
  [[nodiscard]] const std::vector<Cylinder>& carved() const { return carved_; }

 private:
  /// A cylinder before and after; -1 for one that came or went.
  struct Pair {
    int before = -1;
    int after = -1;
  };
  void pair_up();
  [[nodiscard]] bool changed_enough() const;

  CarvingRules rules_;
  std::vector<Cylinder> carved_;
  std::vector<int> holes_;  // of each in the mesh
  std::vector<Cylinder> next_;
  std::vector<int> next_holes_;
  std::vector<Pair> pairs_;
};

}  // namespace navvi_nav::plan
