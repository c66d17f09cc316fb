#pragma once

#include <cstdint>
#include <vector>

#include "bake/tile_bake.hpp"

namespace navvi_nav::bake {

/// A corner of a region's outline. Outlines run clockwise as seen from above, holes the other way,
/// so the region is on the right.
struct OutlineCorner {
  int x = 0;
  int y = 0;
  bool wall = false;  ///< the edge that begins here has a wall on its left
};

/// Positive if `at` is on the left of the way between the other two, 0 if on its line.
[[nodiscard]] std::int64_t turn(const OutlineCorner& from, const OutlineCorner& to,
                                const OutlineCorner& at);

/// Positive for an outline, negative for a hole.
[[nodiscard]] std::int64_t twice_area(const std::vector<OutlineCorner>& outline);

/// From cells (0, 0 at the tile's lower corner) to steps. Every corner on a wall moves out by
/// `grow` steps, away from the open cells, but never off the line of the tile's border: so the
/// neighbouring tile, which sees the same cells, moves it to the same place.
void grow_walls(std::vector<OutlineCorner>& outline, const TileCells& cells, int grow);

/// Leaves out corners in notches of walls: those from which the wall's chord lies on the region's
/// side, at most `error` steps away. What remains encloses a part of what it did.
void fill_notches(std::vector<OutlineCorner>& outline, double error);

}  // namespace navvi_nav::bake
