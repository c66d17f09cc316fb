#pragma once

#include <filesystem>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {

/// Reads a world from our own YAML:
///
///     name: room
///     floor_height: 0.0                  # m, optional
///     things:
///       - name: ground                   # unique
///         class: floor                   # floor, shelf, wall, box, pedestal, worker, ...
///         pose: [0, 0, 0, 0, 0, 0]       # m and rad: x, y, z, roll, pitch, yaw; optional
///         shapes:
///           - box: [8, 6, 0.1]           # m, or  cylinder: [radius, length],  or  sphere: radius
///             pose: [0, 0, -0.05]        # in the thing's frame; 3 or 6 numbers; optional
///         route:                         # optional
///           waypoints:                   # two or more
///             - [0, 0]                   # m
///             - {at: [2, 0], pause: 5, speed: 0.3}   # s, m/s on the way to it; both optional
///           speed: 0.5                   # m/s; the rest is optional
///           pause: 1.0                   # s, at way-points that say nothing else
///           loop: true                   # false: ends at the last way-point
///           delay: 0                     # s, before each round
///           yields: true                 # stops for the robot
///
/// The world is not validated yet (validate.hpp).
/// \throws WorldError with file and line for what is missing, unknown, repeated or of a wrong type
[[nodiscard]] WorldDescription read_yaml_world(const std::filesystem::path& file);

}  // namespace navvi_sim::read
