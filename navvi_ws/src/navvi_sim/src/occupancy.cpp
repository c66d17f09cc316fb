#include "navvi_sim/occupancy.hpp"

#include <algorithm>
#include <cmath>

#include "closed_mesh.hpp"
#include "solid.hpp"

namespace navvi_sim {
namespace {

constexpr double kReach = 0.05;  // share of a voxel's edge that a shape must reach into
constexpr std::size_t kMaxNodes = 20'000'000;
constexpr std::size_t kMostFilled = 2'000;  // triangles of a mesh
constexpr double kWidestFilled = 4.0;       // m, the lesser side: what is wider may be a building
constexpr unsigned kDepth = 16;             // of octomap's trees

/// What there is to put into a map.
struct Bodies {
  /// A solid must reach into a voxel by this much on each side.
  struct Filled {
    Solid solid;
    double reach;  ///< m
  };
  std::vector<Filled> solids;
  std::vector<ClosedMesh> closed;
  std::vector<Triangle> triangles;

  [[nodiscard]] std::size_t count() const {
    return solids.size() + closed.size() + triangles.size();
  }
};

/// An octomap::OcTree that begins with a root; octomap's own begins with the path to one voxel.
class RootedTree : public octomap::OcTree {
 public:
  explicit RootedTree(double resolution) : octomap::OcTree(resolution) {
    root = new octomap::OcTreeNode;
    root->setLogOdds(getClampingThresMaxLog());
    ++tree_size;
  }
};

/// Puts bodies into a tree from its root down, all of them at once: of a cell that they fill, one
/// node is made, whatever its size, and of a cell that they leave free, none. So no node is made
/// that pruning would take away again.
class TreeBuilder {
 public:
  TreeBuilder(const Bodies& bodies, double resolution) : bodies_(bodies), tree_(resolution) {
    for (std::size_t i = 0; i < bodies.count(); ++i) candidates_.push_back({i, 0});
  }

  void build_into(octomap::OcTree& tree) {
    const Cell cell{Eigen::Vector3d::Zero(), tree_.getNodeSize(0) / 2.0};
    Branch root{nullptr, 0, cell, tree_.getRoot(), 0, candidates_.size()};
    if (fill(root, 0) != Overlap::none) tree.swapContent(tree_);
  }

 private:
  using Node = octomap::OcTreeNode;

  struct Candidate {
    std::size_t body;
    unsigned touched;  ///< the eighths of the branch's cell that it reaches into
  };
  /// A cell of the tree, and the bodies that may reach into it: `candidates_` from begin to end.
  struct Branch {
    Branch* parent;
    unsigned index;  ///< among the parent's children
    Cell cell;
    Node* node;  ///< null until something is put in
    std::size_t begin;
    std::size_t end;
  };

  Node* grow(Branch& branch) {
    if (branch.node == nullptr) branch.node = add_child(grow(*branch.parent), branch.index);
    return branch.node;
  }
  Node* add_child(Node* node, unsigned i) {
    if (tree_.size() >= kMaxNodes)
      throw WorldError("the OctoMap of this world comes to more than " + std::to_string(kMaxNodes) +
                       " nodes; allowed is a smaller world or a coarser resolution than " +
                       std::to_string(tree_.getResolution()) + " m");
    Node* child = tree_.createNodeChild(node, i);
    child->setLogOdds(tree_.getClampingThresMaxLog());
    return child;
  }

  /// What reaches by its way into the voxels of an eighth, reaches so into the eighth.
  [[nodiscard]] Octants octants_in(std::size_t body, const Cell& cell) const {
    if (body < bodies_.solids.size())
      return octants(bodies_.solids[body].solid, cell, bodies_.solids[body].reach);
    body -= bodies_.solids.size();
    if (body < bodies_.closed.size()) return bodies_.closed[body].octants(cell);
    return octants(bodies_.triangles[body - bodies_.closed.size()], cell);
  }

  /// Fills a branch; what of it is occupied. If all of it is, no node was made in it.
  Overlap fill(Branch& branch, unsigned depth) {
    unsigned touched = 0;
    unsigned full = 0;
    for (std::size_t i = branch.begin; i < branch.end; ++i) {
      const Octants part = octants_in(candidates_[i].body, branch.cell);
      candidates_[i].touched = part.touched;
      touched |= part.touched;
      full |= part.full;
    }
    if (depth + 1 == kDepth) full = touched;
    bool grew = false;
    for (unsigned i = 0; i < 8; ++i) {
      if (!((touched & ~full) >> i & 1U)) continue;
      const Overlap part = fill_child(branch, i, depth + 1);
      if (part == Overlap::full) full |= 1U << i;
      grew = grew || part == Overlap::partial;
    }
    if (full == 0xFFU) return Overlap::full;
    for (unsigned i = 0; i < 8; ++i)
      if (full >> i & 1U) add_child(grow(branch), i);
    return full != 0 || grew ? Overlap::partial : Overlap::none;
  }

  Overlap fill_child(Branch& parent, unsigned i, unsigned depth) {
    Branch child{&parent, i, octant(parent.cell, i), nullptr, candidates_.size(), 0};
    for (std::size_t k = parent.begin; k < parent.end; ++k)
      if (candidates_[k].touched >> i & 1U) candidates_.push_back({candidates_[k].body, 0});
    child.end = candidates_.size();
    const Overlap part = fill(child, depth);
    candidates_.resize(child.begin);
    return part;
  }

  const Bodies& bodies_;
  RootedTree tree_;
  std::vector<Candidate> candidates_;  ///< a stack of those of the branches from the root down
};

/// Adds a shape of any kind to the bodies.
class BodyMaker {
 public:
  /// \param enclosing  the inside of a closed mesh is where one drives
  BodyMaker(Bodies& bodies, const Eigen::Isometry3d& pose, double resolution, bool enclosing)
      : bodies_(bodies), pose_(pose), resolution_(resolution), enclosing_(enclosing) {}

  void operator()(const Box& box) const { add(solid_box(box.size, pose_), box.size.minCoeff()); }
  void operator()(const Cylinder& cylinder) const {
    add(SolidCylinder(cylinder, pose_), std::min(2.0 * cylinder.radius, cylinder.length));
  }
  void operator()(const Sphere& sphere) const {
    add(SolidSphere(sphere, pose_.translation()), 2.0 * sphere.radius);
  }
  void operator()(const std::shared_ptr<const Mesh>& mesh) const {
    // A surface has no inside to reach into: it counts a little below where it is instead.
    const Eigen::Vector3d down = -kReach * resolution_ * Eigen::Vector3d::UnitZ();
    std::vector<Triangle> triangles;
    for (const auto& indices : mesh->triangles) {
      Triangle triangle;
      for (std::size_t i = 0; i < 3; ++i)
        triangle.corners[i] = pose_ * mesh->vertices[indices[i]].cast<double>() + down;
      triangles.push_back(triangle);
    }
    bodies_.triangles.insert(bodies_.triangles.end(), triangles.begin(), triangles.end());
    if (enclosing_ || triangles.size() > kMostFilled) return;
    for (ClosedMesh& part : closed_parts(triangles))
      if (part.bounds().sizes().head<2>().minCoeff() <= kWidestFilled)
        bodies_.closed.push_back(std::move(part));
  }

 private:
  /// \param thickness  m, the least extent of the solid
  void add(Solid solid, double thickness) const {
    bodies_.solids.push_back({std::move(solid), std::min(kReach * resolution_, thickness / 4.0)});
  }

  Bodies& bodies_;
  Eigen::Isometry3d pose_;
  double resolution_;
  bool enclosing_;
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
  const double border = std::round(world.floor_height / config.resolution) * config.resolution;
  const Eigen::Translation3d lift(0.0, 0.0, border - world.floor_height);
  Bodies bodies;
  for (const Thing& thing : world.things) {
    if (thing.route) continue;
    for (const Shape& shape : thing.shapes) {
      check_reach(thing, shape, tree);
      const Eigen::Isometry3d pose = lift * (thing.pose * shape.pose);
      const bool enclosing =
          thing.thing_class == ThingClass::floor || thing.thing_class == ThingClass::wall;
      std::visit(BodyMaker(bodies, pose, config.resolution, enclosing), shape.geometry);
    }
  }
  TreeBuilder(bodies, config.resolution).build_into(tree);
  return tree;
}

}  // namespace navvi_sim
