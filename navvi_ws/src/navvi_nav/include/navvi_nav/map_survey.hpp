#pragma once

#include <octomap/OcTree.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "navvi_nav/tile_field.hpp"

namespace navvi_nav {

/// Column and row of a tile; (0, 0) has its lower corner at the origin of map.
using TileIndex = std::pair<int, int>;

/// Everything an OctoMap shows, as height fields in tiles: spans straight from the tree's leaves.
struct MapSurvey {
  std::string error;          ///< a sentence if the map cannot be surveyed
  double cell_size = 0.0;     ///< m
  double level_height = 0.0;  ///< m, the map's voxel
  int lowest_level = 0;       ///< level 0 of the fields, in voxels above z = 0
  Cell low;                   ///< lower cell of all tiles
  Cell high;                  ///< one beyond the upper cell
  std::map<TileIndex, TileField> fields;

  /// Top of the floor in levels: the lowest level that shows at least half as much area with
  /// `headroom` free levels above it as the largest does.
  [[nodiscard]] int floor_top(int headroom) const;
  /// Settles all fields on that floor. \returns the ground of all cells, row by row
  [[nodiscard]] std::vector<Ground> settle(int floor_top, int headroom);
};

/// \param cell_size  m, 0 for the map's voxel \param tile_size  m
[[nodiscard]] MapSurvey survey_map(const octomap::OcTree& tree, double cell_size, double tile_size);

}  // namespace navvi_nav
