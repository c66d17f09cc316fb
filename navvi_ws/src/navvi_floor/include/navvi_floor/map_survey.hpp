#pragma once

#include "navvi_floor/floor.hpp"
#include "navvi_floor/octomap_reader.hpp"
#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// Chooses the floor and classifies each cell (R-NAV-12).
///
/// A voxel's top is a place to stand if `robot_height` above it is free. The floor is the level on
/// which the robot stands: of those within 0.25 m of `stands_at` that show at least a quarter as
/// many such places as the largest of them does, the nearest. `floor_height` has precedence, and
/// must have such a level. Where there is neither, the floor is the lowest level that shows at
/// least half as many places as the largest does. From there the floor spreads to neighbours over
/// steps and ramps, one height a cell, the floor's own level first:
///
/// - A step is climbed if it is at most `climb` high. Voxels of 0.05 m or less show what rises by
///   5 cm, so a pedestal or a kerb of 5 cm is an obstacle (R-NAV-12). Coarser ones cannot: a step
///   of one voxel may be the floor's own roughness, and is climbed.
/// - A ramp shows as steps of one voxel, at least three in a row at equal distances of up to 1.2 m.
///   So ramps from 1 in 24 (of voxels of 0.05 m) to less than 45 degrees (R-NAV-1) are floor, and
///   so is what they lead to. A kerb or a pedestal is one such step, or a higher one.
/// - With `climb` 0 there is neither: the robot stays on its level.
///
/// Slopes of 45 degrees and more over 7 columns, as those from 39 degrees on look in places, and
/// the upper side of a step that is not climbed, are obstacles, like all else that rises above the
/// floor and hangs lower than `robot_height`. Where the map shows nothing there is no floor.
///
/// All this is done in the map's own voxels. If cells differ, a cell is floor only if all of it is,
/// and an obstacle if a part is. With `cell_size` 0 they are parts of voxels where else erosion by
/// `margin` would close a way that is 6 cm wider than the robot.
[[nodiscard]] MapSurvey survey_map(const Voxels& voxels, const SurveyConfig& config);
/// All but the cells of that, once for surveys that look for the same floor.
void see_ground(Voxels& voxels, const SurveyConfig& config);

/// Likewise, of a map as it comes. Only the least rectangle round all that differs from a map
/// before is read and surveyed, with what is around it: as far as a ramp could be seen, and
/// wherever floor that was climbed to is joined to it. All is surveyed if that is more than half of
/// the map, or if the map's size or the floor's level changes. \param record, floor  of the map
/// before, with the same config; may both be null
[[nodiscard]] MapSurvey survey_map(const MapBytes& bytes, const SurveyConfig& config,
                                   const SurveyRecord* record = nullptr,
                                   const Floor* floor = nullptr);

}  // namespace navvi_floor
