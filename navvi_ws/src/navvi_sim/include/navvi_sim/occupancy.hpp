#pragma once

#include <octomap/OcTree.h>

#include <navvi_config/field.hpp>

#include "navvi_sim/world_description.hpp"
#include "navvi_sim/world_error.hpp"

namespace navvi_sim {

struct OccupancyConfig {
  double resolution = 0.05;  ///< m, edge of a voxel

  void describe(navvi_config::Visitor& visit);
};

/// The map of everything that stands still (things with a route are left out), pruned, in the
/// frame map. Occupied: every voxel that a shape reaches into by more than 5 % of the voxel's edge
/// along each axis, so that a floor whose top lies on a voxel border does not occupy the voxel
/// above it. Boxes, cylinders and spheres are filled, meshes are surfaces. Free space is not
/// marked. With the built-in worlds the floor's top is z = 0, a border of voxels.
/// \throws WorldError if the world needs more than 60 million voxels at this resolution
[[nodiscard]] octomap::OcTree occupancy_of(const WorldDescription& world,
                                           const OccupancyConfig& config);

}  // namespace navvi_sim
