#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "description/aabb_tree.hpp"
#include "description/footprint.hpp"
#include "traffic/lanes.hpp"

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

/// A thing's name for sentences.
[[nodiscard]] inline std::string quoted(const Thing& thing) { return "'" + thing.name + "'"; }

/// The ground that a body sweeps between two places of its track, a little wider in curves.
[[nodiscard]] Polygon swept(const Track& track, const Footprint& print, double from, double to);

/// The ground of each block of a lane.
[[nodiscard]] std::vector<Polygon> ground_of(const Lane& lane);

/// What stands, seen from above: a polygon a shape or triangle, with its heights.
struct Standing {
  std::size_t thing;  ///< index in WorldDescription::things
  double bottom;      ///< m, in map
  double top;         ///< m
  Polygon polygon;
};

/// Shows all that stands higher than `least` m above the floor, piece by piece: meshes are large.
void for_each_standing(const WorldDescription& world, double least,
                       const std::function<void(const Standing&)>& visit);

}  // namespace navvi_sim::traffic
