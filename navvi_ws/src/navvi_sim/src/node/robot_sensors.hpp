#pragma once

#include <ros/ros.h>

#include <optional>
#include <vector>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"
#include "navvi_sim/sensors/sensors.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "node/sensor_conversion.hpp"

namespace navvi_sim::node {

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
