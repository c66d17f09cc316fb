#pragma once

#include "smooth/guide_cost.hpp"

namespace navvi_nav::smooth {

struct SmoothingConfig {
  bool enabled = true;
  int attempts = 20;
  double effort = 80.0;
  double max_stretch = 1.25;
  double max_detour = 2.0;
  double keep = 6.0;
  GuideCostConfig cost;

  void describe(navvi_config::Visitor& visit);
};

/// A path for a person (R-NAV-13) made of one whose corners touch obstacles: its corners are moved
/// off them, OMPL's PathSimplifier leaves out and adds corners, and those that remain are moved
/// while that pays; all under the same cost. The ends stay, and no leg leaves the mesh. At most
/// `effort` times the path's length is measured; what is best by then stands.
/// \param path  on the mesh
[[nodiscard]] Path smooth(const Path& path, const GuideCost& cost, const SmoothingConfig& config);

}  // namespace navvi_nav::smooth
