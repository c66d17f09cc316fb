#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::picture {

/// A shape from above, cut at the height below which the robot needs free space.
struct Outline {
  std::vector<std::vector<Eigen::Vector2d>> rings;  ///< m, in map
  double bottom = 0.0;                              ///< m
  double top = 0.0;                                 ///< m
  std::vector<std::vector<Eigen::Vector2d>> solid;  ///< likewise, where a mesh is cut; holes count
  std::vector<std::vector<Eigen::Vector2d>> lines;  ///< m, in map: vertical faces
  ThingClass look = ThingClass::other;
  bool is_box = false;
  bool hangs = false;         ///< wholly above the cut: the robot passes under it
  Eigen::AlignedBox2d local;  ///< m, in the thing's frame
};

/// What is seen of a thing from above: what another of its shapes covers is left out. Boxes and
/// cylinders that lie askew are shown by their bounds, and what hangs of a mesh by its hull. What
/// the robot drives over looks like floor.
/// \param floor  m, in map
[[nodiscard]] std::vector<Outline> outlines_of(const Thing& thing, double floor);

}  // namespace navvi_sim::picture
