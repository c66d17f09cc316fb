#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "description/aabb_tree.hpp"
#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::physics {

/// One shape of a body.
struct Part {
  Geometry geometry;
  Eigen::Isometry3d pose;      ///< in map; of what moves, in the thing's frame
  Eigen::AlignedBox3d bounds;  ///< in map, at time zero; the heights hold for what moves, too
  const AabbTree* triangles = nullptr;  ///< of a mesh, in its own frame
};

/// A thing that the robot can touch.
struct Body {
  std::size_t thing;  ///< index in WorldDescription::things
  bool moves;
  std::vector<Part> parts;
  Eigen::AlignedBox3d bounds;  ///< in map, at time zero
};

/// The bodies of a world, and where those are that stand. A shape lower than the robot's underside
/// has none; neither name nor class decides. Memory is linear in shapes and triangles.
class Bodies {
 public:
  /// \param description  valid (validate.hpp); it need not outlive the constructor
  /// \param underside    m, z in map of the robot's lower face
  Bodies(const WorldDescription& description, double underside);

  /// Ordered by thing.
  [[nodiscard]] const std::vector<Body>& all() const { return bodies_; }
  /// Of what stands, indices in standing().
  [[nodiscard]] const AabbTree& tree() const { return tree_; }
  /// Indices in all().
  [[nodiscard]] const std::vector<std::size_t>& standing() const { return standing_; }
  /// The body of a thing; nullptr if it has none.
  [[nodiscard]] const Body* of(std::size_t thing) const;

 private:
  std::vector<Body> bodies_;
  std::vector<std::size_t> standing_;
  AabbTree tree_;
  std::map<const Mesh*, std::unique_ptr<AabbTree>> triangles_;
};

}  // namespace navvi_sim::physics
