#pragma once

#include <navvi_config/field.hpp>

#include "smooth/channel.hpp"

namespace navvi_nav::smooth {

struct SmoothingConfig {
  bool enabled = true;
  int steps = 20;
  double clearance_weight = 3.0;
  double turn_price = 1.0;
  double short_leg = 2.0;
  double max_stretch = 1.25;
  double max_detour = 2.0;

  void describe(navvi_config::Visitor& visit);
};

/// m: the length of the path, each metre dearer the less of the preferred clearance it keeps.
[[nodiscard]] double guide_cost(const Path& path, const map::Space& space, const Clearances& room,
                                const SmoothingConfig& config);

/// A path for a person (R-NAV-13) made of the shortest one: it keeps clear of obstacles and has few
/// corners. The best way-points in the channel of `path` are chosen, then OMPL's PathSimplifier
/// polishes them under the same cost. The result has the same ends, leads through the same channel,
/// is clear by `room.radius` from end to end, and is at most max_stretch times as long as `path` or
/// max_detour longer; on any doubt it is `path` itself. Work is bounded by counts, not by a clock:
/// equal input gives equal output.
[[nodiscard]] Path smooth(const Path& path, const map::Space& space, const Clearances& room,
                          const SmoothingConfig& config);

}  // namespace navvi_nav::smooth
