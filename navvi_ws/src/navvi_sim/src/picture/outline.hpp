#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::picture {

/// A shape from above.
struct Outline {
  std::vector<std::vector<Eigen::Vector2d>> rings;  ///< m, in map
  double bottom = 0.0;                              ///< m
  double top = 0.0;                                 ///< m
  ThingClass look = ThingClass::other;
  bool is_box = false;
  Eigen::AlignedBox2d local;  ///< m, in the thing's frame
};

/// What is seen of a thing from above: what another of its shapes covers is left out. Boxes and
/// cylinders that lie askew are shown by their bounds.
[[nodiscard]] std::vector<Outline> outlines_of(const Thing& thing);

}  // namespace navvi_sim::picture
