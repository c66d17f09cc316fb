#pragma once

#include <navvi_files/cache.hpp>

#include "navvi_sim/scenario/scenario.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"

namespace navvi_sim::setup {

/// What a trial needs of its world before anything moves.
struct Course {
  navvi_floor::Voxels voxels;
  scenario::StartAndGoal ends;
};

/// By voxels_of, and scenario_of or what that once was for the same world and config.
/// \param world  of load_world \param cache  nullptr: nothing is kept
/// \throws ConfigError or WorldError with a sentence
[[nodiscard]] Course course_of(const SimNodeConfig& config, const WorldDescription& world,
                               const navvi_files::Cache* cache = nullptr);

}  // namespace navvi_sim::setup
