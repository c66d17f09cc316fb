#pragma once

#include <optional>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// m, in map: the height at which most of the level, upward surface of the floor things lies, by
/// area; of heights with about the same area the highest. nullopt if no surface is level.
[[nodiscard]] std::optional<double> main_floor_height(const std::vector<Thing>& things);

/// m, in map: the highest point of a thing.
[[nodiscard]] double top_of(const Thing& thing);

/// m, in map: the box along the axes that holds all of `things`; empty for none.
[[nodiscard]] Eigen::AlignedBox3d bounds_of(const std::vector<Thing>& things);

}  // namespace navvi_sim
