#pragma once

#include <string>
#include <vector>

#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// "50 million"
[[nodiscard]] inline std::string millions(double count) {
  return std::to_string(static_cast<long long>(count / 1e6)) + " million";
}

/// m, of a map from the origin of map: farther away the search could take a corner for one that it
/// is not, by the rounding of its coordinates.
inline constexpr double kFarthestMap = 10'000.0;

/// Squares of ground that need not lie on the mesh's lattice.
struct GroundGrid {
  double cell_size = 0.0;  ///< m
  Point origin;            ///< m, lower corner of the first square in map
  int columns = 0;
  int rows = 0;
  std::vector<Ground> ground;  ///< row by row
};

/// The grid in cells on the lattice through the origin of map: a cell is floor only if all of it
/// is, and an obstacle if a part is. Sets all but the floor's height; an error if there would be
/// too many cells, or if it lies too far from the origin.
/// \param how  of which `cell_size`, `margin` and `most_cells` count
[[nodiscard]] MapSurvey resample(const GroundGrid& grid, const SurveyConfig& how);

}  // namespace navvi_floor
