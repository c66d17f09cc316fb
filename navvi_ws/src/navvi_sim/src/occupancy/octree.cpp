#include "occupancy/octree.hpp"

#include <sstream>

namespace navvi_sim::occupancy {

std::unique_ptr<octomap::OcTree> octree_of(const OccupancyMap& map) {
  auto tree = std::make_unique<octomap::OcTree>(map.resolution());
  if (map.stream().empty()) return tree;
  std::istringstream stream(std::string(map.stream().begin(), map.stream().end()));
  tree->readBinaryData(stream);
  return tree;
}

}  // namespace navvi_sim::occupancy
