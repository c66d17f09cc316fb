#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <octomap_msgs/Octomap.h>
#include <visualization_msgs/MarkerArray.h>

#include <navvi_types/checked.hpp>
#include <string>

#include "plan/plan_request.hpp"

namespace navvi_nav::node {

[[nodiscard]] plan::MapMessage from_msg(const octomap_msgs::Octomap& map);
/// Why the map cannot be used in `frame`, without a full stop; empty if it may be.
[[nodiscard]] std::string error_of(const octomap_msgs::Octomap& map, const std::string& frame);
/// Why the grid's origin or size cannot be used; read_grid() judges the rest.
[[nodiscard]] navvi_types::Checked<map::OccupancyGrid> from_msg(const nav_msgs::OccupancyGrid& map);
/// The mesh as cyan triangles a little above the floor (R-VIS-3); holes are where there are none.
[[nodiscard]] visualization_msgs::MarkerArray to_msg(const mesh::Mesh& mesh, double z,
                                                     const std::string& frame,
                                                     const ros::Time& stamp);
/// The borders of zones on the floor: a line of closed ones, dashes of slow ones.
[[nodiscard]] visualization_msgs::MarkerArray to_msg(const map::Zones& zones, double z,
                                                     const std::string& frame,
                                                     const ros::Time& stamp);

}  // namespace navvi_nav::node
