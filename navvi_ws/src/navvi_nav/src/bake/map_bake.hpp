#pragma once

#include <map>
#include <memory>
#include <navvi_floor/floor.hpp>
#include <navvi_floor/survey.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bake/tile_bake.hpp"

namespace navvi_nav::bake {

/// Column and row of a tile; (0, 0) has its lower corner at the origin of map.
using TileIndex = std::pair<int, int>;

struct MapBakeConfig {
  double margin = 0.35;        ///< m, that the mesh keeps from everything that blocks
  double reach = 1.0;          ///< m, beyond the margin, that distances are known
  double tile_size = 32.0;     ///< m, about; at most 1024 cells
  double contour_error = 1.0;  ///< cells, as BakeConfig's
  double max_edge = 0.0;       ///< m, longer walls are split; 0: never
  int max_corners = 12;        ///< of a polygon
  bool fine_parts = true;      ///< finer cells where whole ones would close a passage
  bool watershed = false;      ///< as BakeConfig's
  int threads = 2;             ///< that may share the work; the result is the same
};

/// Polygons of the parts of a tile, row by row, before they are merged across the parts' borders.
using TileParts = std::vector<std::shared_ptr<const std::vector<mesh::GridPolygon>>>;

/// A map's floor and its mesh without holes.
struct BakedMap {
  std::string error;  ///< a sentence if the survey shows no floor for the robot
  std::shared_ptr<const map::Floor> floor;
  std::shared_ptr<const map::SurveyRecord> record;  ///< of its survey; null: there is none
  int tile_cells = 0;                               ///< cells along a tile's side
  /// Corners in steps of the floor's cell size / kStepsPerCellSide. Tiles without floor are left
  /// out.
  std::map<TileIndex, std::vector<mesh::GridPolygon>> tiles;
  std::vector<TileIndex> rebuilt;  ///< tiles that are not as in the map before, gone ones included
  std::map<TileIndex, TileParts> parts;  ///< of all tiles
};

/// Bakes a survey. Parts around which the ground is as in `before` are taken over from there, not
/// baked again: same cells, same polygons.
[[nodiscard]] BakedMap bake_map(map::MapSurvey survey, const MapBakeConfig& config,
                                const BakedMap* before = nullptr);

}  // namespace navvi_nav::bake
