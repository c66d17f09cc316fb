#pragma once

#include "smooth/guide_cost.hpp"

namespace navvi_nav::smooth {

struct SmoothingConfig {
  bool enabled = true;
  int attempts = 20;
  double effort = 60.0;
  double search_effort = 60.0;
  double max_stretch = 1.25;
  double max_detour = 2.0;
  double keep = 6.0;
  GuideCostConfig cost;

  void describe(navvi_config::Visitor& visit);
};

/// A path for a person (R-NAV-13) made of one whose corners touch obstacles: its corners are moved
/// off them; then they are moved and others added while that pays, and OMPL's PathSimplifier leaves
/// out those that do not, all under the same cost. The ends stay, and no leg leaves the mesh. When
/// all that `cost` allows has been measured, what is best by then stands.
/// \param path  on the mesh
[[nodiscard]] Path sketch(const Path& path, const GuideCost& cost, const SmoothingConfig& config);
/// The same again in smaller steps, for the best of the sketches.
[[nodiscard]] Path refine(const Path& path, const GuideCost& cost, const SmoothingConfig& config);

}  // namespace navvi_nav::smooth
