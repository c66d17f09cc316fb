#pragma once

#include <vector>

#include "map/floor.hpp"
#include "map/height_field.hpp"

namespace navvi_nav::map {

/// All in levels of the map, which are as high as its columns are wide.
struct Climbing {
  int floor_top = 0;
  int headroom = 1;
  int step = 0;           ///< the highest that is climbed
  int longest_tread = 1;  ///< columns between two steps of a ramp
};

/// Lets the floor at `floor_top` spread over steps of at most `step`, and of one level where a ramp
/// shows as such; takes back what is as steep as 45 degrees and the upper sides of other steps.
void spread_floor(std::vector<Ground>& ground, const HeightField& field, const Climbing& climbing);

}  // namespace navvi_nav::map
