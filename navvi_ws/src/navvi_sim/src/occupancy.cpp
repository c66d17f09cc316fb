#include "navvi_sim/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "solid.hpp"

namespace navvi_sim {
namespace {

constexpr double kReach = 0.05;  // share of a voxel's edge that a shape must reach into
constexpr std::size_t kMaxNodes = 20'000'000;
constexpr unsigned kDepth = 16;  // of octomap's trees

/// Puts solids into a tree from its root down: a cell that lies wholly in a solid becomes one node,
/// whatever its size.
class Filler {
 public:
  explicit Filler(octomap::OcTree& tree) : tree_(tree) {}

  /// \param thickness  m, the least extent of the solid
  template <typename Solid>
  void fill(const Solid& solid, double thickness) {
    const double shrink = std::min(kReach * tree_.getResolution(), thickness / 4.0);
    Branch root = this->root();
    fill(solid, shrink, root, 0);
  }

  void fill(const std::vector<Convex>& triangles) {
    std::vector<std::size_t> all(triangles.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    Branch root = this->root();
    fill(triangles, all, root, 0);
  }

 private:
  using Node = octomap::OcTreeNode;

  /// A cell of the tree, whose node may not be there yet: octomap cannot take away a node again
  /// once it had children, so nodes grow only when something is put in.
  struct Branch {
    Branch* parent;
    unsigned index;  ///< among the parent's children
    Cell cell;
    Node* node;
  };

  [[nodiscard]] Branch root() const {
    return {nullptr, 0, {Eigen::Vector3d::Zero(), tree_.getNodeSize(0) / 2.0}, tree_.getRoot()};
  }
  [[nodiscard]] Branch child(Branch& parent, unsigned i) const {
    const double half = parent.cell.half / 2.0;
    const Eigen::Vector3d step((i & 1U) ? half : -half, (i & 2U) ? half : -half,
                               (i & 4U) ? half : -half);
    const bool exists = parent.node != nullptr && tree_.nodeChildExists(parent.node, i);
    return {&parent,
            i,
            {parent.cell.centre + step, half},
            exists ? tree_.getNodeChild(parent.node, i) : nullptr};
  }
  [[nodiscard]] bool is_full(const Node* node) const {
    return node != nullptr && !tree_.nodeHasChildren(node) && node->getLogOdds() > 0.0F;
  }

  Node* grow_child(Node* node, unsigned i) {
    if (tree_.nodeChildExists(node, i)) return tree_.getNodeChild(node, i);
    if (tree_.size() >= kMaxNodes)
      throw WorldError("the OctoMap of this world comes to more than " + std::to_string(kMaxNodes) +
                       " nodes; allowed is a smaller world or a coarser resolution than " +
                       std::to_string(tree_.getResolution()) + " m");
    return tree_.createNodeChild(node, i);
  }
  Node* grow(Branch& branch) {
    if (branch.node == nullptr) {
      Node* parent = grow(*branch.parent);
      branch.node = grow_child(parent, branch.index);
    }
    return branch.node;
  }
  void set_full(Node* node) {
    if (tree_.nodeHasChildren(node)) {
      for (unsigned i = 0; i < 8; ++i) set_full(grow_child(node, i));
      tree_.pruneNode(node);
    }
    node->setLogOdds(tree_.getClampingThresMaxLog());
  }
  void set_full(Branch& branch) {
    if (tree_.getRoot() == nullptr) {
      // octomap makes a root only with a first voxel.
      const Eigen::Vector3d& c = branch.cell.centre;
      tree_.updateNode(c.x(), c.y(), c.z(), true);
      for (Branch* up = &branch; up != nullptr; up = up->parent)
        if (up->parent == nullptr) up->node = tree_.getRoot();
    }
    set_full(grow(branch));
  }

  template <typename Solid>
  void fill(const Solid& solid, double shrink, Branch& branch, unsigned depth) {
    if (is_full(branch.node)) return;
    const bool leaf = depth + 1 == kDepth;
    for (unsigned i = 0; i < 8; ++i) {
      Branch inner = child(branch, i);
      if (leaf) inner.cell.half -= shrink;
      const Overlap overlap = solid.overlap(inner.cell);
      if (overlap == Overlap::none) continue;
      if (leaf || overlap == Overlap::full)
        set_full(inner);
      else
        fill(solid, shrink, inner, depth + 1);
    }
    if (branch.node != nullptr) tree_.pruneNode(branch.node);
  }

  void fill(const std::vector<Convex>& triangles, const std::vector<std::size_t>& candidates,
            Branch& branch, unsigned depth) {
    if (is_full(branch.node)) return;
    std::vector<std::size_t> inside;
    for (unsigned i = 0; i < 8; ++i) {
      Branch inner = child(branch, i);
      inside.clear();
      for (const std::size_t candidate : candidates)
        if (triangles[candidate].overlap(inner.cell) != Overlap::none) inside.push_back(candidate);
      if (inside.empty()) continue;
      if (depth + 1 == kDepth)
        set_full(inner);
      else
        fill(triangles, inside, inner, depth + 1);
    }
    if (branch.node != nullptr) tree_.pruneNode(branch.node);
  }

  octomap::OcTree& tree_;
};

/// Puts one shape of any kind into the tree.
class ShapeFiller {
 public:
  ShapeFiller(Filler& filler, const Eigen::Isometry3d& pose, double resolution)
      : filler_(filler), pose_(pose), resolution_(resolution) {}

  void operator()(const Box& box) const {
    filler_.fill(Convex::box(box.size, pose_), box.size.minCoeff());
  }
  void operator()(const Cylinder& cylinder) const {
    filler_.fill(SolidCylinder(cylinder, pose_), std::min(2.0 * cylinder.radius, cylinder.length));
  }
  void operator()(const Sphere& sphere) const {
    filler_.fill(SolidSphere(sphere, pose_.translation()), 2.0 * sphere.radius);
  }
  void operator()(const std::shared_ptr<const Mesh>& mesh) const {
    // A surface has no inside to reach into: it counts a little below where it is instead.
    const Eigen::Vector3d down = -kReach * resolution_ * Eigen::Vector3d::UnitZ();
    std::vector<Convex> triangles;
    triangles.reserve(mesh->triangles.size());
    for (const auto& triangle : mesh->triangles) {
      std::array<Eigen::Vector3d, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = pose_ * mesh->vertices[triangle[i]].cast<double>() + down;
      triangles.push_back(Convex::triangle(corners));
    }
    filler_.fill(triangles);
  }

 private:
  Filler& filler_;
  Eigen::Isometry3d pose_;
  double resolution_;
};

/// Half the length of a cube around the shape's frame that holds the shape.
struct Extent {
  double operator()(const Box& box) const { return box.size.norm() / 2.0; }
  double operator()(const Cylinder& cylinder) const {
    return std::hypot(cylinder.radius, cylinder.length / 2.0);
  }
  double operator()(const Sphere& sphere) const { return sphere.radius; }
  double operator()(const std::shared_ptr<const Mesh>& mesh) const {
    float extent = 0.0F;
    for (const Eigen::Vector3f& vertex : mesh->vertices) extent = std::max(extent, vertex.norm());
    return static_cast<double>(extent);
  }
};

void check_reach(const Thing& thing, const Shape& shape, const octomap::OcTree& tree) {
  const double reach = tree.getNodeSize(0) / 2.0;
  const double extent = (thing.pose * shape.pose).translation().cwiseAbs().maxCoeff() +
                        std::visit(Extent{}, shape.geometry);
  if (!(extent < reach))
    throw WorldError("thing '" + thing.name + "' reaches " + std::to_string(extent) +
                     " m from the origin; allowed is less than " + std::to_string(reach) +
                     " m at the OctoMap's resolution of " + std::to_string(tree.getResolution()) +
                     " m");
}

}  // namespace

void OccupancyConfig::describe(navvi_config::Visitor& visit) {
  visit({"resolution", navvi_config::Range{0.01, 1.0}, "m", "edge of a voxel of the OctoMap"},
        resolution);
}

octomap::OcTree occupancy_of(const WorldDescription& world, const OccupancyConfig& config) {
  octomap::OcTree tree(config.resolution);
  Filler filler(tree);
  const double border = std::round(world.floor_height / config.resolution) * config.resolution;
  const Eigen::Translation3d lift(0.0, 0.0, border - world.floor_height);
  for (const Thing& thing : world.things) {
    if (thing.route) continue;
    for (const Shape& shape : thing.shapes) {
      check_reach(thing, shape, tree);
      Eigen::Isometry3d pose = thing.pose * shape.pose;
      if (thing.thing_class == ThingClass::floor) pose = lift * pose;
      std::visit(ShapeFiller(filler, pose, config.resolution), shape.geometry);
    }
  }
  tree.updateInnerOccupancy();
  tree.prune();
  return tree;
}

}  // namespace navvi_sim
