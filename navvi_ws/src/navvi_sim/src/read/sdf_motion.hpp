#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"
#include "read/sdf_notes.hpp"
#include "read/xml_element.hpp"

namespace navvi_sim::read {

/// In Gazebo, actors walk through things and through each other. Here a route that collides
/// (lanes.hpp) is taken off its thing, which then stands where the route begins; a note says why.
/// \param places  where each of the world's things stands in its file
void keep_routes_that_can_be_driven(WorldDescription& world, const std::vector<std::string>& places,
                                    SdfNotes& notes);

/// How something in an SDF world moves: where it is at time zero, and its route if it has one.
struct SdfMotion {
  Eigen::Isometry3d start;  ///< in map
  std::optional<Route> route;
};

/// The motion of an <actor> by its <script>: trajectories one after the other, way-points at times.
/// Between way-points it walks straight on; way-points at one place are a pause. A loop that does
/// not end where it began walks back, where Gazebo jumps.
/// \param pose  of the actor in map, where it stands if no script moves it
[[nodiscard]] SdfMotion actor_motion(const XmlElement& actor, const Eigen::Isometry3d& pose,
                                     SdfNotes& notes);

}  // namespace navvi_sim::read
