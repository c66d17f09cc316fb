#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "description/aabb_tree.hpp"
#include "description/footprint.hpp"

namespace navvi_sim::traffic {

/// Polygons by where they lie.
class PolygonIndex {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;

  /// \param polygons  kept by reference; those without corners are nowhere
  /// \param gap       m, at which two of them count as touching
  PolygonIndex(const std::vector<Polygon>& polygons, double gap);

  /// Pairs (a, b), a < b, of polygons that touch, in order, of those that are `wanted`.
  [[nodiscard]] std::vector<Pair> pairs(const std::function<bool(const Pair&)>& wanted) const;
  /// Polygons that overlap `other`, in order.
  [[nodiscard]] std::vector<std::size_t> touching(const Polygon& other) const;

 private:
  const std::vector<Polygon>& polygons_;
  double gap_;
  std::vector<Eigen::AlignedBox3d> bounds_;  ///< wider by half of the gap, at z = 0
  AabbTree tree_;
};

}  // namespace navvi_sim::traffic
