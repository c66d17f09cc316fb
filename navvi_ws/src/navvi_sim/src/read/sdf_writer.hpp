#pragma once

#include <string>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::read {

/// The world as SDF 1.7, for Gazebo and for read_sdf_world (sdf_world.hpp), which gives it back
/// thing by thing: one static model a thing, one link, a collision and a visual a shape. What SDF
/// has no word for stands in elements of our own, which Gazebo passes over:
///
///     <navvi:class>pallet_robot</navvi:class>             in a model
///     <navvi:route speed="0.7" loop="true" delay="0" yields="true">
///       <navvi:waypoint pause="4" speed="0">1 2</navvi:waypoint>   m in map, s, m/s
///     </navvi:route>
///     <navvi:look>box</navvi:look>                        in a collision
///
/// \param visuals  whether Gazebo is to show what is there; without, the text is half as long
/// \throws WorldError for a world with a mesh, which SDF keeps in a file of its own
[[nodiscard]] std::string to_sdf(const WorldDescription& world, bool visuals = true);

}  // namespace navvi_sim::read
