#pragma once

#include <vector>

#include "traffic/lanes.hpp"

namespace navvi_sim::traffic {

/// Finds which ground the lanes share, and where their users can wait on ground of their own: fills
/// spacing, is_private and segments.
/// \param lanes   laid, with their users
/// \param ground  of all blocks, lane by lane
/// \throws WorldError naming the things, if there is no such place, or if they start in each
///         other's way
void find_waiting_zones(const WorldDescription& world, std::vector<Polygon> ground, Lanes& lanes);

}  // namespace navvi_sim::traffic
