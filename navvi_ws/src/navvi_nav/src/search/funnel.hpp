#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace navvi_nav::search {

/// The shortest polyline from `start` to `goal` that crosses each portal in order (R-NAV-7).
/// Simple Stupid Funnel, after Mononen, "Simple Stupid Funnel Algorithm", 2010; linear in the
/// number of portals except where it restarts from a corner. Repeated points are left out.
[[nodiscard]] Path funnel(Point start, Point goal, const std::vector<mesh::Interval>& portals);

}  // namespace navvi_nav::search
