#pragma once

#include <octomap/OcTree.h>

#include <sstream>
#include <string>

#include "occupancy/octree.hpp"

namespace navvi_sim {

/// The map as octomap reads it.
inline octomap::OcTree tree_of(const occupancy::OccupancyMap& map) {
  return *occupancy::octree_of(map);
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
