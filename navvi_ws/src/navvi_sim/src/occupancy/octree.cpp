#include "occupancy/octree.hpp"

#include <sstream>

namespace navvi_sim::occupancy {
namespace {

constexpr double kRounding = 1e-6;  // of a voxel

/// A cube of the tree, m.
struct Cube {
  Eigen::Vector3d low;
  double side;

  [[nodiscard]] Eigen::AlignedBox3d box() const {
    return {low, low + Eigen::Vector3d::Constant(side)};
  }
  [[nodiscard]] Cube child(unsigned i) const {
    const double half = side / 2.0;
    return {low + half * Eigen::Vector3d(i & 1U, i >> 1U & 1U, i >> 2U & 1U), half};
  }
};

void fill(octomap::OcTree& tree, octomap::OcTreeNode& node, const Cube& cube,
          const Eigen::AlignedBox3d& space) {
  for (unsigned i = 0; i < 8; ++i) {
    const Cube part = cube.child(i);
    if (space.intersection(part.box()).sizes().minCoeff() <= 0.5 * tree.getResolution()) continue;
    if (tree.nodeChildExists(&node, i)) {
      octomap::OcTreeNode* const known = tree.getNodeChild(&node, i);
      if (tree.nodeHasChildren(known)) fill(tree, *known, part, space);
    } else if (space.contains(part.box())) {
      tree.createNodeChild(&node, i)->setLogOdds(tree.getClampingThresMinLog());
    } else if (part.side > 1.5 * tree.getResolution()) {
      fill(tree, *tree.createNodeChild(&node, i), part, space);
    }
  }
}

}  // namespace

std::unique_ptr<octomap::OcTree> octree_of(const OccupancyMap& map) {
  auto tree = std::make_unique<octomap::OcTree>(map.resolution());
  if (map.stream().empty()) return tree;
  std::istringstream stream(std::string(map.stream().begin(), map.stream().end()));
  tree->readBinaryData(stream);
  return tree;
}

void mark_free(octomap::OcTree& tree, const Eigen::AlignedBox3d& space) {
  if (tree.getRoot() == nullptr) return;
  const double half = OccupancyMap::kCenter * tree.getResolution();
  // On borders of voxels, so that each cube that is split has a part that is free.
  const double margin = kRounding * tree.getResolution();
  const Eigen::Array3d low = (space.min().array() / tree.getResolution() - kRounding).ceil();
  const Eigen::Array3d high = (space.max().array() / tree.getResolution() + kRounding).floor();
  fill(tree, *tree.getRoot(), {Eigen::Vector3d::Constant(-half), 2.0 * half},
       {low * tree.getResolution() - margin, high * tree.getResolution() + margin});
  tree.updateInnerOccupancy();
}

OccupancyMap map_of(octomap::OcTree& tree) {
  std::ostringstream stream;
  if (tree.getRoot() != nullptr) tree.writeBinaryData(stream);
  const std::string bytes = stream.str();
  return {tree.getResolution(), {bytes.begin(), bytes.end()}};
}

}  // namespace navvi_sim::occupancy
