#pragma once

#include <octomap/OcTree.h>

#include <memory>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::occupancy {

/// The map as the OctoMap library holds it.
[[nodiscard]] std::unique_ptr<octomap::OcTree> octree_of(const OccupancyMap& map);

}  // namespace navvi_sim::occupancy
