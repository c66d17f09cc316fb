#pragma once

#include <optional>
#include <vector>

#include "bake/tile_cells.hpp"

namespace navvi_nav::bake {

/// Regions, their contours, and convex polygons, by Recast (R-NAV-3).
/// \param cells  that walls grow away from
/// \param rest  those to cover; none of them alone
/// \return nothing where Recast fails the two sums of bake_tile()
/// \throws std::runtime_error if it runs out of memory
[[nodiscard]] std::optional<std::vector<mesh::GridPolygon>> recast_polygons(
    const TileCells& cells, const TileCells& rest, const BakeConfig& config);

}  // namespace navvi_nav::bake
