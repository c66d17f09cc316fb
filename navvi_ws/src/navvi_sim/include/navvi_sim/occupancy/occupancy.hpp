#pragma once

#include <navvi_config/field.hpp>
#include <navvi_floor/octomap_reader.hpp>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::occupancy {

struct OccupancyConfig {
  double resolution = 0.05;  ///< m, edge of a voxel
  double underside = 0.05;   ///< m above the floor, of the robot: lower things are driven over

  void describe(navvi_config::Visitor& visit);
};

/// The map of everything that stands still (things with a route are left out), pruned, in the
/// frame map. Occupied: every voxel that a shape reaches into by more than 5 % of the voxel's edge
/// along each axis, so that a top that lies on a border of voxels does not occupy the voxel above
/// it. Boxes, cylinders and spheres are filled, and so is the inside of a mesh's closed parts,
/// except in floors and walls, in meshes of more than 2000 triangles, and in parts more than 4 m
/// long and wide, which may be buildings (polylines have no hollow and are always filled); other
/// meshes are surfaces, which occupy the voxels on both sides where they stand on a border. Free
/// space is not marked.
///
/// The whole world is moved along z, by half a voxel at most, so that `floor_height` falls on a
/// border of voxels: a thing on the floor then shows above it wherever the floor lies (R-NAV-12).
/// Only what reaches the robot's underside is a thing: shapes, and triangles of meshes, that end
/// nearer to the floor's height are made level with it, as the robot drives over them.
///
/// The bytes are those that octomap writes after it has inserted the same voxels and pruned its
/// tree. \throws WorldError if a shape reaches further than the tree does (32 768 voxels to each
/// side), or the map comes to more than the 64 MiB that navigation takes
[[nodiscard]] OccupancyMap occupancy_of(const WorldDescription& world,
                                        const OccupancyConfig& config);

/// What navigation reads of a map.
[[nodiscard]] navvi_floor::Voxels voxels_of(const OccupancyMap& map);
/// The same voxels as of occupancy_of(world, config), the boxes of the world as boxes: no tree is
/// written of them and read again, and none is too large.
[[nodiscard]] navvi_floor::Voxels voxels_of(const WorldDescription& world,
                                            const OccupancyConfig& config);

}  // namespace navvi_sim::occupancy
