#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "navvi_sim/occupancy/slice.hpp"
#include "navvi_sim/sensors/sensors.hpp"

// What the simulated robot's sensors publish, each in the sensor's frame.

namespace navvi_sim::node {

/// \param lidar  whose first and last rays are the ends of its field
[[nodiscard]] sensor_msgs::LaserScan scan_msg(const sensors::Sensor& lidar,
                                              const sensors::Reading& reading,
                                              const std::string& frame);
/// A point a pixel, m, x ahead; not finite where nothing was measured.
/// \param columns  pixels from left to right
[[nodiscard]] sensor_msgs::PointCloud2 cloud_msg(const sensors::Sensor& camera,
                                                 const sensors::Reading& reading, int columns,
                                                 const std::string& frame);
/// base_link -> the sensor's frame, which stands still.
[[nodiscard]] geometry_msgs::TransformStamped mount_msg(const sensors::Sensor& sensor,
                                                        const std::string& frame);
/// In map.
[[nodiscard]] nav_msgs::OccupancyGrid to_msg(const occupancy::Slice& slice, double floor);

}  // namespace navvi_sim::node
