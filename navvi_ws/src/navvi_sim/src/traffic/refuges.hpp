#pragma once

#include <vector>

#include "traffic/lanes.hpp"

namespace navvi_sim::traffic {

/// Finds which ground the lanes share, and where on them their users can wait out of each other's
/// way: fills spacing, is_private and legs.
/// \param lanes   laid, with their users
/// \param ground  of all blocks, lane by lane
/// \throws WorldError naming the things, if there is no such place, or if they start in each
///         other's way
void find_refuges(const WorldDescription& world, std::vector<Polygon> ground, Lanes& lanes);

}  // namespace navvi_sim::traffic
