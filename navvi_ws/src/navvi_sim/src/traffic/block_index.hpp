#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "description/footprint.hpp"

namespace navvi_sim::traffic {

/// Polygons by where they lie: a uniform grid over their bounds.
class BlockIndex {
 public:
  using Pair = std::pair<std::size_t, std::size_t>;

  /// \param polygons  kept by reference; those without corners are nowhere
  /// \param gap       m, at which two of them count as touching
  BlockIndex(const std::vector<Polygon>& polygons, double gap);

  /// Pairs (a, b), a < b, of polygons that touch, in order, of those that are `wanted`.
  [[nodiscard]] std::vector<Pair> pairs(const std::function<bool(const Pair&)>& wanted) const;
  /// Polygons that overlap `other`, in order.
  [[nodiscard]] std::vector<std::size_t> touching(const Polygon& other) const;

 private:
  struct Entry {
    std::uint64_t cell;
    std::size_t polygon;
    bool operator<(const Entry& other) const {
      return cell != other.cell ? cell < other.cell : polygon < other.polygon;
    }
  };

  const std::vector<Polygon>& polygons_;
  double gap_;
  std::vector<Eigen::AlignedBox2d> bounds_;  ///< wider by half of the gap
  std::vector<Entry> entries_;               ///< sorted
};

[[nodiscard]] Eigen::AlignedBox2d bounds_of(const Polygon& polygon);

}  // namespace navvi_sim::traffic
