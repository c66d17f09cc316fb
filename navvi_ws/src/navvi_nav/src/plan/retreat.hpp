#pragma once

#include <vector>

#include "plan/route.hpp"

namespace navvi_nav::plan {

/// The shortest route of a robot at `start` to a place outside of `swept_area`, with some room to
/// it where there is; without a path if there is no such place within 12 m.
[[nodiscard]] Route find_retreat(RouteFinder& routes, const std::vector<Cylinder>& swept_area,
                                 Point start);

}  // namespace navvi_nav::plan
