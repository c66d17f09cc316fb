#pragma once

#include <geometry_msgs/Transform.h>
#include <nav_msgs/OccupancyGrid.h>
#include <octomap_msgs/Octomap.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <navvi_types/checked.hpp>
#include <navvi_types/thing.hpp>
#include <optional>
#include <vector>

#include "navvi_perception/sight/sight.hpp"

namespace navvi_perception::node {

using navvi_types::Checked;

// Incoming messages, or why one is dropped whole (safety rule 2).

/// The scan with finite angles, times and limits, and at least one ray.
[[nodiscard]] Checked<sensor_msgs::LaserScan::ConstPtr> from_msg(const sensor_msgs::LaserScan& msg);
/// The cloud with x, y and z as floats or doubles, and as much data as it announces: row after row,
/// whatever its row_step says, or rows of row_step. At most 4 million points; none is a cloud, too.
[[nodiscard]] Checked<sensor_msgs::PointCloud2::ConstPtr> from_msg(
    const sensor_msgs::PointCloud2& msg);
/// The grid, turned or not, with a resolution within 0.01 and 1 m.
[[nodiscard]] Checked<sight::Prior> from_msg(const nav_msgs::OccupancyGrid& msg);

/// nullopt if a number is not finite or too far, or the rotation none.
[[nodiscard]] std::optional<Eigen::Isometry3d> pose_of(const geometry_msgs::Transform& transform);

/// The finite points of a cloud that was checked, every k-th so that `most` remain at most, m.
[[nodiscard]] std::vector<Eigen::Vector3d> points_of(const sensor_msgs::PointCloud2& cloud,
                                                     std::size_t most);

/// s, from the first ray to the last
[[nodiscard]] double sweep_of(const sensor_msgs::LaserScan& scan);
/// The scan as in REP-117: a ray between range_min and range_max as it is, one that met nothing
/// +inf, any other NaN. \param free  so do drivers tell that a ray met nothing: 0, NaN, or
/// range_max and more
[[nodiscard]] sensor_msgs::LaserScan plain(sensor_msgs::LaserScan scan, bool free);
/// A plain scan with rays that met nothing as long as the sensor sees: they are points, too.
[[nodiscard]] sensor_msgs::LaserScan with_clear_rays(sensor_msgs::LaserScan scan);
/// Adds a plain scan's points to the hits, or where rays met nothing to what is clear.
/// \param cloud  made of with_clear_rays(scan) by laser_geometry with channel Index, in map
void add_points(const sensor_msgs::LaserScan& scan, const sensor_msgs::PointCloud2& cloud,
                sight::Sight& sight);

/// \param bytes  as OcTree::writeBinaryData
[[nodiscard]] octomap_msgs::Octomap map_msg(const std::vector<std::int8_t>& bytes,
                                            double resolution, std::int64_t stamp,
                                            const std::string& frame);
/// For RViz: the robot as a cylinder with a flat arrow head on it that shows its heading, as in the
/// simulator. \param radius  m \param height  m \param frame  base_link
[[nodiscard]] std::vector<visualization_msgs::Marker> robot_markers(double radius, double height,
                                                                    const std::string& frame);
/// For RViz: what stands as cubes, each obstacle as a cylinder, with an arrow before it as long as
/// its way in a second.
/// \param standing  m, middles of voxels \param resolution  m, their edge
[[nodiscard]] visualization_msgs::MarkerArray seen_msg(const std::vector<Eigen::Vector3d>& standing,
                                                       double resolution,
                                                       const navvi_types::Obstacles& obstacles,
                                                       const std::string& frame);

}  // namespace navvi_perception::node
