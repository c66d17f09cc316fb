#pragma once

#include <cstddef>
#include <vector>

#include "geometry.hpp"

namespace navvi_nav::smooth {

/// The change of course, rad, below which a corner is a bend: it is followed, not announced.
inline constexpr double kBend = navvi_types::radians(15.0);

/// What a person meets as one change of course: corners of a path that follow each other closely.
struct Turn {
  std::size_t at = 0;  ///< index of the first of them, or of the path's end
  double angle = 0.0;  ///< rad, clockwise, of all together, [-pi, pi]; 0 at the end
};

/// The turns of a path in their order, without bends, and at last the path's end.
/// \param together  m: corners nearer than this to the one before are one turn with it; 0: each
/// corner is a turn, however small
[[nodiscard]] std::vector<Turn> turns_of(const Path& path, double together);

}  // namespace navvi_nav::smooth
