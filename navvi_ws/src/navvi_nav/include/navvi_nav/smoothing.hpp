#pragma once

#include <navvi_config/field.hpp>

#include "navvi_nav/floor.hpp"

namespace navvi_nav {

struct SmoothingConfig {
  bool enabled = true;
  int steps = 60;
  double clearance_weight = 3.0;
  double turn_price = 1.0;
  double max_stretch = 1.25;
  double max_detour = 2.0;

  void describe(navvi_config::Visitor& visit);
};

/// What a path must keep: `radius` always, `radius + preferred` where there is room, m.
struct Room {
  double radius = 0.35;
  double preferred = 0.6;
};

/// m: the length of the path, each metre dearer the less of the preferred clearance it keeps.
[[nodiscard]] double guide_cost(const Path& path, const Space& space, const Room& room,
                                const SmoothingConfig& config);

/// A path for a person (R-NAV-13): OMPL's PathSimplifier first shortens `path` and then moves it
/// away from what is near; few corners are kept of the result. It has the same ends, is clear by
/// `room.radius` from end to end, and is at most max_stretch times as long as `path` or max_detour
/// longer; on any doubt it is `path` itself. Equal input gives equal output.
[[nodiscard]] Path smooth(const Path& path, const Space& space, const Room& room,
                          const SmoothingConfig& config);

}  // namespace navvi_nav
