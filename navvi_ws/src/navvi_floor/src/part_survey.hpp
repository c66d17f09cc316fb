#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "floor_rules.hpp"
#include "height_field.hpp"
#include "navvi_floor/floor.hpp"
#include "navvi_floor/octomap_reader.hpp"
#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// x, y, z and side, in voxels, of the occupied leaves that are in no block.
using Leaf = std::array<int, 4>;

/// What is kept of a map until the next one was surveyed.
struct SurveyRecord {
  std::vector<std::int8_t> data;  // the map's own, to which `bytes` points
  MapBytes bytes;
  std::vector<Block> blocks;
  std::vector<Leaf> leaves;
  HeightField::Extent extent;
  Places places;
  int floor_level = 0;
  std::vector<bool> climbed;  // columns of the extent, row by row: floor that was spread to
};

/// The ground that columns of voxels show, not in cells yet.
struct SeenGround {
  std::string error;  // a sentence if there is none
  SurveyConfig how;
  SurveyRecord record;
  GroundGrid grid;
};

/// Columns of a cube.
[[nodiscard]] inline Area columns_of(int x, int y, int side) {
  const Cell low{x - kMapCenter, y - kMapCenter};
  return {low, {low.x + side, low.y + side}};
}
[[nodiscard]] inline Area columns_of(const Block& block) {
  return columns_of(block.low[0], block.low[1], 1 << kBlockLevel);
}
[[nodiscard]] inline Area columns_of(const HeightField::Extent& extent) {
  return {{extent.low[0], extent.low[1]}, {extent.high[0], extent.high[1]}};
}

/// Surveys what differs from the map before. \returns nothing if all must be surveyed
/// \param changed  columns outside of which both maps are the same
/// \param floor  of the map before \param record  of the new map
[[nodiscard]] std::optional<MapSurvey> survey_part(const Area& changed, const FloorRules& rules,
                                                   const SurveyRecord& before, const Floor& floor,
                                                   SurveyRecord& record);

}  // namespace navvi_floor
