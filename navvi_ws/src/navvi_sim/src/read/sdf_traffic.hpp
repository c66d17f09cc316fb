#pragma once

#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "read/sdf_notes.hpp"

namespace navvi_sim::read {

/// In Gazebo, actors walk through things and through each other. Here a route that collides
/// (lanes.hpp) is taken off its thing, which then stands where the route begins; a note says why.
/// \param places  where each of the world's things stands in its file
void keep_routes_that_can_be_driven(WorldDescription& world, const std::vector<std::string>& places,
                                    SdfNotes& notes);

}  // namespace navvi_sim::read
