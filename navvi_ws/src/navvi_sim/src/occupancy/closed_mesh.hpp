#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "occupancy/solid.hpp"

namespace navvi_sim::occupancy {

/// A body by its closed surface.
class ClosedMesh {
 public:
  explicit ClosedMesh(std::vector<Triangle> triangles);

  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Exact, however the triangles are wound: an eighth is touched where the surface passes or where
  /// it lies inside, and full where it lies inside and no surface passes.
  [[nodiscard]] Octants octants(const Cell& cell) const;

 private:
  [[nodiscard]] bool holds(const Eigen::Vector3d& point) const;

  std::vector<Triangle> triangles_;
  Eigen::AlignedBox3d bounds_;
};

/// The parts of a surface that are closed: of those triangles that hang together by their corners,
/// every side belongs to an even number.
[[nodiscard]] std::vector<ClosedMesh> closed_parts(const std::vector<Triangle>& triangles);

}  // namespace navvi_sim::occupancy
