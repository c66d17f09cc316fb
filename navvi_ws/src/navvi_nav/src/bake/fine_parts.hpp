#pragma once

#include <navvi_floor/floor.hpp>

#include "bake/tile_bake.hpp"

namespace navvi_nav::bake {

/// Where whole cells may close a passage that is wide enough, the tile gets the open places in
/// cells of 1/4 to 1/16, eroded by the exact distance: there a way is lost only if it is less than
/// 3 cm wider than the robot. Such places are where a closed cell may hold room enough and the open
/// cells around it (5 x 5) are not one piece: a strait between them, or a passage without any.
///
/// \param margin  m, that these places keep from everything that blocks
void add_fine_parts(TileCells& cells, const map::Floor& floor, double margin);

}  // namespace navvi_nav::bake
