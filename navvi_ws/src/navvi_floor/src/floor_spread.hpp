#pragma once

#include <algorithm>
#include <vector>

#include "height_field.hpp"
#include "navvi_floor/floor.hpp"

namespace navvi_floor {

/// All in levels of the map, which are as high as its columns are wide.
struct Climbing {
  int floor_top = 0;
  int headroom = 1;
  int step = 0;           ///< the highest that is climbed
  int longest_tread = 1;  ///< columns between two steps of a ramp

  /// Columns: how far from two neighbours it is seen whether a ramp joins them.
  [[nodiscard]] int ramp_reach() const { return 2 * longest_tread + 2; }
  /// Columns to each side of one, by which it is judged whether it is steep.
  [[nodiscard]] int steep_reach() const { return std::max(3, step); }
};

/// Lets the floor at `floor_top` spread over steps of at most `step`, and of one level where a ramp
/// shows as such; takes back what is as steep as 45 degrees and the upper sides of other steps.
/// \returns the columns that it spread to, those taken back included
std::vector<int> spread_floor(std::vector<Ground>& ground, const HeightField& field,
                              const Climbing& climbing);

}  // namespace navvi_floor
