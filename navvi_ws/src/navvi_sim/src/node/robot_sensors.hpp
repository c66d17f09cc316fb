// What the simulated robot's sensors publish, each in the sensor's frame.

#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"
#include "navvi_sim/occupancy/slice.hpp"
#include "navvi_sim/sensors/sensors.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"

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

/// The sensors of the robot and its bumper, where there are any: what they publish is all that a
/// robot knows of the world.
class RobotSensors {
 public:
  RobotSensors(ros::NodeHandle& node, const setup::SimNodeConfig& config,
               const WorldDescription& world, const occupancy::OccupancyMap& map);

  /// Where they are on the robot.
  [[nodiscard]] std::vector<geometry_msgs::TransformStamped> mounts() const;
  /// Call it after each step.
  void publish(const live::Session& session);

 private:
  int columns_;
  sensors::Sensors sensors_;
  std::optional<sensors::Sensor> lidar_, camera_;
  ros::Publisher scan_, points_, bumper_, prior_;
  bool bumped_ = false;
};

}  // namespace navvi_sim::node
