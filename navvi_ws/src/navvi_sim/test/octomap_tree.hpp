#pragma once

#include <octomap/OcTree.h>

#include <sstream>
#include <string>

#include "navvi_sim/occupancy/occupancy_map.hpp"

namespace navvi_sim {

/// The map as octomap reads it.
inline octomap::OcTree tree_of(const occupancy::OccupancyMap& map) {
  octomap::OcTree tree(map.resolution());
  if (map.stream().empty()) return tree;
  std::istringstream stream(std::string(map.stream().begin(), map.stream().end()));
  tree.readBinaryData(stream);
  return tree;
}

/// What octomap writes of a tree.
inline std::string stream_of(const octomap::OcTree& tree) {
  std::ostringstream stream;
  if (tree.getRoot() != nullptr) tree.writeBinaryNode(stream, tree.getRoot());
  return stream.str();
}

inline bool occupied(const octomap::OcTree& tree, double x, double y, double z) {
  const octomap::OcTreeNode* node = tree.search(x, y, z);
  return node != nullptr && tree.isNodeOccupied(node);
}

}  // namespace navvi_sim
