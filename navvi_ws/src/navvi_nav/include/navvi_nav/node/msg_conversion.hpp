#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Obstacles.h>
#include <octomap_msgs/Octomap.h>
#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "navvi_nav/guide/navigator.hpp"

namespace navvi_nav::node {

/// m, coordinates beyond are taken for garbage.
inline constexpr double kFarthest = 1e5;

/// nullopt if any number is not finite or out of range, or the rotation is no unit quaternion.
[[nodiscard]] std::optional<Pose> from_msg(const geometry_msgs::Transform& transform);
/// Forward speed, m/s; nullopt if the twist is not finite or absurd.
[[nodiscard]] std::optional<double> speed_from_msg(const nav_msgs::Odometry& odometry);
/// nullopt if any number of any obstacle is not finite or out of range (radius and height: above
/// 0 and up to 20 m), a rectangle is none or does not lie within its cylinder, an id repeats, or
/// there are more than 10000. The frame is not looked at.
[[nodiscard]] std::optional<std::vector<guide::MovingThing>> from_msg(
    const navvi_msgs::Obstacles& obstacles);
/// nullopt if a number is not finite or the position absurd. The frame is not looked at, and the
/// direction need not be a rotation: a goal is a place.
[[nodiscard]] std::optional<Point> from_msg(const geometry_msgs::PoseStamped& goal);
[[nodiscard]] plan::MapMessage from_msg(const octomap_msgs::Octomap& map);
/// Why the map cannot be used in `frame`, without a full stop; empty if it may be.
[[nodiscard]] std::string error_of(const octomap_msgs::Octomap& map, const std::string& frame);
/// nullopt if the grid is not in `frame`, the origin is not finite, absurd or no rotation about z,
/// or the size beyond all bounds; read_grid() judges the rest.
[[nodiscard]] std::optional<map::OccupancyGrid> from_msg(const nav_msgs::OccupancyGrid& map,
                                                         const std::string& frame);

[[nodiscard]] nav_msgs::Path to_msg(const Path& path, double z, const std::string& frame,
                                    const ros::Time& stamp);
/// All but `seq` and `blocked_by`.
[[nodiscard]] navvi_msgs::Guidance to_msg(const guide::Status& status, double z,
                                          const std::string& frame, const ros::Time& stamp);
/// The mesh as cyan triangles a little above the floor (R-VIS-3); holes are where there are none.
[[nodiscard]] visualization_msgs::MarkerArray to_msg(const mesh::Mesh& mesh, double z,
                                                     const std::string& frame,
                                                     const ros::Time& stamp);

}  // namespace navvi_nav::node
