#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::occupancy {

/// A flat map, as one that was made by a lidar.
struct Slice {
  double resolution = 0.0;                           ///< m, edge of a cell
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, lower corner of cell (0, 0) in map
  int width = 0;                                     ///< cells along x
  int height = 0;                                    ///< cells along y
  std::vector<std::int8_t>
      cells;  ///< row by row: -1 no floor, 0 floor, 100 occupied at that height
};

/// \param floor   m, z of the floor in map \param height  m above it
[[nodiscard]] Slice slice_of(const OccupancyMap& map, double floor, double height);

}  // namespace navvi_sim::occupancy
