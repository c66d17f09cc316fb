#pragma once

#include <optional>
#include <string>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/scenario/scenario.hpp"

namespace navvi_sim::picture {

/// The world from above as an SVG document, north (y) up, cut at the robot's headroom: every thing
/// by its outline in the colour of its class, with a mark of the class where the outline alone is
/// not clear, and what hangs above the cut by a dashed line; routes dashed, stops on them as
/// diamonds; start, goal and the way between them; a scale bar and a legend. A few things that lie
/// far from all others are left out, and the caption tells how many. \param scenario  nullopt:
/// without start and goal \param caption   one line under the name of the world, such as its seed;
/// may be empty
[[nodiscard]] std::string world_picture(const WorldDescription& world,
                                        const std::optional<scenario::StartAndGoal>& scenario,
                                        const std::string& caption);

}  // namespace navvi_sim::picture
