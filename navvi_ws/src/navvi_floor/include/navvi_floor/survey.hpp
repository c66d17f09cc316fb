#pragma once

#include <memory>
#include <navvi_types/motion.hpp>
#include <optional>
#include <string>

#include "navvi_floor/floor.hpp"

namespace navvi_floor {

/// Of a map seen from above, as columns of voxels or as squares of floor: the latter take 4 bytes
/// each as long as the map is in use. 300 x 300 m at 0.05 m are 36 million.
inline constexpr double kMaxCells = 50.0e6;
inline constexpr double kAnyFloor = -1000.0;  ///< m, SurveyConfig::floor_height: choose by area

struct SurveyConfig {
  double cell_size = 0.0;  ///< m, edge of a cell; 0: the map's own, or a part of it
  double robot_height =
      navvi_types::kHeadroom;       ///< m, a thing that hangs higher over the floor is none
  double climb = 0.04;              ///< m, the highest step that is driven over; 0: no ramp either
  double floor_height = kAnyFloor;  ///< m, z of the floor to take
  int threads = 2;                  ///< that may share the work; the result is the same
  double margin = 0.35;             ///< m, that the floor will be eroded by
  std::optional<double> stands_at;  ///< m, z of the robot's base_link, which is on the floor
  double most_cells = kMaxCells;    ///< of more, several along each side become one
};

struct SurveyRecord;

/// What a map shows, seen from above: which squares are floor.
struct MapSurvey {
  std::string error;          ///< a sentence if the map cannot be surveyed
  double cell_size = 0.0;     ///< m
  double floor_height = 0.0;  ///< m, z of the floor's most common level in map
  Cell low;                   ///< lower cell
  int columns = 0;
  int rows = 0;
  Bands<Ground> ground;
  std::string source = {};  ///< what a file says of itself; may be empty
  std::string levels;       ///< where the map shows floor, for a sentence; may be empty
  std::shared_ptr<const SurveyRecord> record = {};  ///< by which the next map can be compared
  bool in_part = false;                             ///< the rest was taken over from the map before
};

}  // namespace navvi_floor
