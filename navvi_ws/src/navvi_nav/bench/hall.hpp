#pragma once

#include <octomap/OcTree.h>

#include <cstdint>
#include <string>

namespace navvi_nav::bench {

/// A warehouse hall as a map: floor at z = 0, walls, shelves of 10 x 1 m in rows, aisles of 3 m
/// between rows and bays. Its south-west corner is the origin of map; all edges lie on voxels of
/// 0.1 m.
struct Hall {
  double length = 50.0;  ///< m, along x, the shelves' direction
  double width = 30.0;   ///< m, along y
  /// m^2 of floor for one box or pedestal at a random place; 0: none, all aisles alike
  double clutter = 0.0;
  std::uint32_t seed = 1;   ///< of the clutter
  double resolution = 0.1;  ///< m

  [[nodiscard]] std::string name() const;  ///< as in "100 x 100 m cluttered"
  [[nodiscard]] octomap::OcTree map() const;
};

}  // namespace navvi_nav::bench
