#pragma once

#include <vector>

#include "navvi_nav/geometry.hpp"

namespace navvi_nav {

/// A part of an edge that a path crosses; right and left as seen on the way.
struct Portal {
  Point right;
  Point left;
};

/// The shortest polyline from `start` to `goal` that crosses each portal in order (R-NAV-7).
/// Simple Stupid Funnel, after Mononen, "Simple Stupid Funnel Algorithm", 2010; linear in the
/// number of portals but where it starts again from a corner. Repeated points are left out.
[[nodiscard]] Path funnel(Point start, Point goal, const std::vector<Portal>& portals);

}  // namespace navvi_nav
