#pragma once

#include <memory>
#include <vector>

#include "plain_recast.hpp"

namespace navvi_nav::plain {

/// Recast used as its samples do: one watershed mesh over the whole map, convex polygons of up to
/// six corners for Detour. The voxels go in as spans, and no height detail is made, so that nothing
/// is paid for that our mesh does not need either.
class Detour {
 public:
  /// \param robot_radius  m, eroded in whole cells \param robot_height  m
  Detour(const Columns& columns, double robot_radius, double robot_height);

  [[nodiscard]] const dtNavMesh& mesh() const { return *mesh_; }
  /// The corners of each polygon in whole cells of map, counter-clockwise.
  [[nodiscard]] const std::vector<std::vector<std::array<int, 2>>>& polygons() const {
    return polygons_;
  }

 private:
  NavMesh mesh_;
  std::vector<std::vector<std::array<int, 2>>> polygons_;
};

}  // namespace navvi_nav::plain
