#pragma once

#include "record/figures.hpp"

namespace navvi_study::record {

/// How well a robot was turned to where it was led, whatever led it.
struct Turns {
  std::vector<double> left;  ///< rad, of turns on the spot, what they left
  std::vector<double> late;  ///< s, from a cue that asks for a turn to a robot that begins it
};
[[nodiscard]] Turns turns_of(const Trial& trial);

/// Where a person stood longest, and whether it was told why the stick moved nothing.
struct Stands {
  int speechless = 0;       ///< pushes in vain for 3 s without a word or a sound
  double longest = 0.0;     ///< s, the longest stay within 0.3 m
  double since = 0.0;       ///< s since the trial began, when that stay began
  std::string about = "n/a";  ///< what was about at its end
};
[[nodiscard]] Stands stands_of(const Trial& trial);

}  // namespace navvi_study::record
