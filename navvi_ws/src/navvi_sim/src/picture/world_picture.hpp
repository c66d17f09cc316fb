#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/scenario/scenario.hpp"

namespace navvi_sim::picture {

/// The path that a person is led along, and where it is said to turn, m in map.
struct Guide {
  std::vector<Eigen::Vector2d> path, turns;
};

/// The world from above as an SVG document, north (y) up, cut at the robot's headroom: every thing
/// by its outline in the colour of its class, with a mark of the class where the outline alone is
/// not clear, and what hangs above the cut by a dashed line; routes dashed, stops on them as
/// diamonds; start, goal and the way between them; a scale bar and a legend. A few things that lie
/// far from all others are left out, and the caption tells how many. \param scenario  nullopt:
/// without start and goal \param caption   one line under the name of the world, such as its seed;
/// may be empty \param guide  drawn instead of the scenario's own way if it is not empty
[[nodiscard]] std::string world_picture(const WorldDescription& world,
                                        const std::optional<scenario::StartAndGoal>& scenario,
                                        const std::string& caption, const Guide& guide = {});

}  // namespace navvi_sim::picture
