#pragma once

#include <cstdint>
#include <vector>

#include "navvi_floor/geometry.hpp"
#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// nav_msgs/OccupancyGrid without ROS: a map for a robot that has no OctoMap.
struct OccupancyGrid {
  int width = 0;                   ///< cells along x
  int height = 0;                  ///< cells along y
  double resolution = 0.0;         ///< m
  Point origin;                    ///< m, lower corner of cell (0, 0) in map
  double yaw = 0.0;                ///< rad, of the grid in map, about its origin
  std::vector<std::int8_t> cells;  ///< row by row: -1 unknown, else 0 (free) to 100 (occupied)
};

inline constexpr double kFreeBelow = 0.196;     ///< of occupancy, as map_server's free_thresh
inline constexpr double kOccupiedAbove = 0.65;  ///< of occupancy, as map_server's occupied_thresh

/// A value between free and occupied is unknown, and an unknown cell is no floor. Everything
/// occupied is an obstacle of unknown height; the floor is at z = 0. A turned grid is laid along
/// the axes of map first: what is blocked grows by less than a cell.
/// \param config  of which `cell_size` and `margin` count
[[nodiscard]] MapSurvey read_grid(const OccupancyGrid& grid, const SurveyConfig& config);

}  // namespace navvi_floor
