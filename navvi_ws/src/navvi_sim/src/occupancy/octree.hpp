#pragma once

#include <octomap/OcTree.h>

#include <Eigen/Geometry>
#include <memory>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::occupancy {

/// The map as the OctoMap library holds it.
[[nodiscard]] std::unique_ptr<octomap::OcTree> octree_of(const OccupancyMap& map);

/// Marks as free what is not occupied, in the largest cubes, as a mapper does that has looked at
/// all of `space`. \param space  m; cubes are free that lie in it as a whole
void mark_free(octomap::OcTree& tree, const Eigen::AlignedBox3d& space);

/// The reverse of octree_of().
[[nodiscard]] OccupancyMap map_of(octomap::OcTree& tree);

}  // namespace navvi_sim::occupancy
