#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "navvi_sim/world_description.hpp"
#include "navvi_sim/world_error.hpp"

namespace navvi_sim {

/// A pose on the floor, in map.
struct FloorPose {
  double x = 0.0;    ///< m
  double y = 0.0;    ///< m
  double yaw = 0.0;  ///< rad, counter-clockwise from x
};

struct ScenarioConfig {
  double robot_radius = 0.35;   ///< m
  double robot_height = 1.2;    ///< m, headroom that the robot needs
  double clearance = 0.15;      ///< m, more than the radius, to anything that stands still
  double mover_distance = 2.0;  ///< m, at least, from the start to a mover at time zero
  double min_route = 10.0;      ///< m, along the floor, where the world permits
};

struct Scenario {
  FloorPose start;
  Eigen::Vector2d goal;       ///< m, in map
  double route_length = 0.0;  ///< m, along a grid of the map; 0 if the goal was given and cannot
                              ///< be reached
};

/// Draws from `seed` what is not given. What is drawn is free, clear of things as `config` says,
/// and connected over the floor. A goal that is given is passed on as it is, free or not: refusing
/// it is navigation's task. A drawn start looks along its route.
/// \param map  of `world` (occupancy.hpp)
/// \throws WorldError if a given start is not finite, in an obstacle or off the floor, or if the
/// world has no free place
[[nodiscard]] Scenario draw_scenario(const WorldDescription& world, const octomap::OcTree& map,
                                     const ScenarioConfig& config, std::uint64_t seed,
                                     const std::optional<FloorPose>& start = std::nullopt,
                                     const std::optional<Eigen::Vector2d>& goal = std::nullopt);

}  // namespace navvi_sim
