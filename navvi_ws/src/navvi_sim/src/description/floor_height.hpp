#pragma once

#include <optional>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// m, in map: the height of the lowest storey on which many of the other things stand, half as many
/// as on any or more. Storeys are where the floor things have much level surface; a storey's height
/// is that of most of its surface, of about equal ones the highest. nullopt if no surface is level.
[[nodiscard]] std::optional<double> main_floor_height(const std::vector<Thing>& things);

/// m, in map: the lowest storey of them, or ceiling that a floor thing makes, from `least` upwards.
[[nodiscard]] std::optional<double> storey_above(const std::vector<Thing>& things, double least);

/// m^2, of a thing's surfaces that are level and lie between two heights in map.
[[nodiscard]] double level_area(const Thing& thing, double low, double high);

/// m, in map: the highest point of a thing.
[[nodiscard]] double top_of(const Thing& thing);

/// The least box along the axes around a geometry at a pose.
[[nodiscard]] Eigen::AlignedBox3d bounds_of(const Geometry& geometry,
                                            const Eigen::Isometry3d& pose);

/// m, in map: the box along the axes that holds all of `things`; empty for none.
[[nodiscard]] Eigen::AlignedBox3d bounds_of(const std::vector<Thing>& things);

/// m, in map: the boxes of the things that rise above the floor by more than 0.1 m.
[[nodiscard]] std::vector<Eigen::AlignedBox3d> standing_in(const WorldDescription& world);

}  // namespace navvi_sim
