#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "map/floor.hpp"
#include "map/octomap_reader.hpp"

namespace navvi_nav::map {

inline constexpr double kAnyFloor = -1000.0;  ///< m, SurveyConfig::floor_height: choose by area

struct SurveyConfig {
  double cell_size = 0.0;           ///< m, edge of a cell; 0: the map's own, or a part of it
  double robot_height = 0.8;        ///< m, a thing that hangs higher over the floor is none
  double climb = 0.04;              ///< m, the highest step that is driven over; 0: no ramp either
  double floor_height = kAnyFloor;  ///< m, z of the floor to take
  int threads = 2;                  ///< that may share the work; the result is the same
  double margin = 0.35;             ///< m, that the floor will be eroded by
  std::optional<double> stands_at;  ///< m, z of the robot's base_link, which is on the floor
};

struct SurveyRecord;

/// What a map shows, seen from above: which squares are floor, row by row.
struct MapSurvey {
  std::string error;          ///< a sentence if the map cannot be surveyed
  double cell_size = 0.0;     ///< m
  double floor_height = 0.0;  ///< m, z of the floor's most common level in map
  Cell low;                   ///< lower cell
  int columns = 0;
  int rows = 0;
  std::vector<Ground> ground;
  std::string source = {};  ///< what a file says of itself; may be empty
  std::string levels;       ///< where the map shows floor, for a sentence; may be empty
  std::shared_ptr<const SurveyRecord> record = {};  ///< by which the next map can be compared
  bool in_part = false;  ///< the rest was taken over from the map before
};

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

/// Likewise, of a map as it comes. Only the least rectangle round all that differs from a map
/// before is read and surveyed, with what is around it: as far as a ramp could be seen, and wherever
/// floor that was climbed to is joined to it. All is surveyed if that is more than half of the map,
/// or if the map's size or the floor's level changes.
/// \param record, floor  of the map before, with the same config; may both be null
[[nodiscard]] MapSurvey survey_map(const MapBytes& bytes, const SurveyConfig& config,
                                   const SurveyRecord* record = nullptr,
                                   const Floor* floor = nullptr);

/// nav_msgs/OccupancyGrid without ROS: a map for a robot that has no OctoMap.
struct OccupancyGrid {
  int width = 0;                   ///< cells along x
  int height = 0;                  ///< cells along y
  double resolution = 0.0;         ///< m
  Point origin;                    ///< m, lower corner of cell (0, 0) in map
  double yaw = 0.0;                ///< rad, of the grid in map; only 0 can be read
  std::vector<std::int8_t> cells;  ///< row by row: -1 unknown, else 0 (free) to 100 (occupied)
};

inline constexpr double kFreeBelow = 0.196;     ///< of occupancy, as map_server's free_thresh
inline constexpr double kOccupiedAbove = 0.65;  ///< of occupancy, as map_server's occupied_thresh

/// A value between free and occupied is unknown, and an unknown cell is no floor. Everything
/// occupied is an obstacle of unknown height; the floor is at z = 0.
/// \param config  of which `cell_size` and `margin` count
[[nodiscard]] MapSurvey read_grid(const OccupancyGrid& grid, const SurveyConfig& config);

}  // namespace navvi_nav::map
