#pragma once

#include <optional>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// m, in map: the height of the storey on which most of the other things stand, of equal ones the
/// lowest. Storeys are where the floor things have much level surface; a storey's height is that of
/// most of its surface, of about equal ones the highest. nullopt if no surface is level.
[[nodiscard]] std::optional<double> main_floor_height(const std::vector<Thing>& things);

/// m^2, of a thing's surfaces that are level and lie between two heights in map.
[[nodiscard]] double level_area(const Thing& thing, double low, double high);

/// m, in map: the highest point of a thing.
[[nodiscard]] double top_of(const Thing& thing);

/// m, in map: the box along the axes that holds all of `things`; empty for none.
[[nodiscard]] Eigen::AlignedBox3d bounds_of(const std::vector<Thing>& things);

}  // namespace navvi_sim
