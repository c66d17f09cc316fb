#pragma once

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim {

/// What a world may hold at most.
struct WorldLimits {
  static constexpr std::size_t things = 20'000;
  static constexpr std::size_t shapes_per_thing = 2'000;
  static constexpr std::size_t shapes = 500'000;       ///< of all things together
  static constexpr std::size_t vertices = 5'000'000;   ///< of all meshes together
  static constexpr std::size_t triangles = 5'000'000;  ///< of all meshes together
  static constexpr std::size_t waypoints = 1'000;      ///< of one route
  static constexpr double extent = 1'000.0;            ///< m, of any size and any coordinate
  static constexpr double speed = 5.0;                 ///< m/s, of a route
  static constexpr double pause = 3'600.0;             ///< s, of a route
};

/// Checks that `world` can be lived in: every number finite and in its range, rotations proper,
/// names unique and not empty, mesh indices inside their meshes, routes that lead somewhere, and a
/// floor of class `floor` (one thing or more).
/// \throws WorldError naming the thing, what is wrong and what is allowed
void validate(const WorldDescription& world);

/// The same of one thing.
void validate(const Thing& thing);

}  // namespace navvi_sim
