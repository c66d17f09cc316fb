#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <navvi_config/field.hpp>
#include <navvi_floor/octomap_reader.hpp>
#include <navvi_types/motion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/traffic/movers_config.hpp"

namespace navvi_sim::scenario {

struct ScenarioConfig {
  double robot_radius = 0.35;                    ///< m
  double robot_height = navvi_types::kHeadroom;  ///< m
  double clearance = 0.15;      ///< m, more than the radius, to anything that stands still
  double off_lanes = 0.3;       ///< m, more than the radius, to ground that movers sweep
  double mover_distance = 2.0;  ///< m, at least, from the start to a mover at time zero
  double min_route = 0.0;       ///< m, along the floor; 0: 10 where the world permits
  double max_route = 0.0;       ///< m; 0: as long as may be

  traffic::MoversConfig movers;  ///< by which they lay their tracks

  /// Only what is asked of the route: the rest follows from the robot.
  void describe(navvi_config::Visitor& visit);
};

struct StartAndGoal {
  Pose2 start;
  Eigen::Vector2d goal;       ///< m, in map
  double route_length = 0.0;  ///< m, along a grid of the map; 0 if the goal was given and cannot
                              ///< be reached
  std::string note = {};  ///< a sentence if one of them lies outside of all that stands, or they
                          ///< are less than 5 m apart; else empty
};

/// Draws from `seed` what is not given. What is drawn is free, clear of things as `config` says,
/// connected over the floor on which navigation drives, on the part of it beside which most things
/// stand, inside the hull of what stands and in its rooms, where there are such that are wide
/// enough, and, where the world has such places, off the ground that movers sweep: a robot that
/// stood there would keep them from going on. A goal that is given is passed on as it is, free or
/// not: refusing it is navigation's task. A drawn start looks along its route. The length that is
/// asked for holds for every route of which an end is drawn.
/// \param voxels  of `world` (occupancy.hpp)
/// \throws WorldError as swept_ground, or if a given start is not finite, in an obstacle or off the
/// floor, if the map has no floor, or if the world has no free place, or none for a route as long
/// as asked for, or of 1 m
[[nodiscard]] StartAndGoal draw_scenario(const WorldDescription& world,
                                         const navvi_floor::Voxels& voxels,
                                         const ScenarioConfig& config, std::uint64_t seed,
                                         const std::optional<Pose2>& start = std::nullopt,
                                         const std::optional<Eigen::Vector2d>& goal = std::nullopt);

/// The world's places in which the robot can stand, each with the free point that is nearest to its
/// middle. \param voxels  of `world`
[[nodiscard]] std::vector<Place> free_places_of(const WorldDescription& world,
                                                const navvi_floor::Voxels& voxels,
                                                const ScenarioConfig& config);

}  // namespace navvi_sim::scenario
