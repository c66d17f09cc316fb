#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <sstream>
#include <string>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim::occupancy {

/// The map as the OctoMap library holds it.
[[nodiscard]] inline std::unique_ptr<octomap::OcTree> octree_of(const OccupancyMap& map) {
  auto tree = std::make_unique<octomap::OcTree>(map.resolution());
  if (map.stream().empty()) return tree;
  std::istringstream stream(std::string(map.stream().begin(), map.stream().end()));
  tree->readBinaryData(stream);
  return tree;
}

}  // namespace navvi_sim::occupancy
