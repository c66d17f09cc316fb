#include "node/robot_sensors.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_msgs/Bool.h>

#include <cmath>
#include <navvi_types/msg_conversion.hpp>

#include "navvi_sim/node/msg_conversion.hpp"

namespace navvi_sim::node {

constexpr const char* kLidarFrame = "laser";
constexpr const char* kCameraFrame = "camera_link";

sensor_msgs::LaserScan scan_msg(const sensors::Sensor& lidar, const sensors::Reading& reading,
                                const std::string& frame) {
  const auto angle = [&](std::size_t i) {
    return std::atan2(lidar.rays()[i].y(), lidar.rays()[i].x());
  };
  sensor_msgs::LaserScan msg;
  msg.header.stamp = navvi_types::from_ns(reading.stamp);
  msg.header.frame_id = frame;
  // The first ray may point straight back: atan2 gives either sign there.
  msg.angle_min = static_cast<float>(-std::abs(angle(0)));
  msg.angle_increment = static_cast<float>(navvi_types::wrap(angle(1) - angle(0)));
  msg.angle_max = msg.angle_min + static_cast<float>(lidar.rays().size() - 1) * msg.angle_increment;
  msg.scan_time = static_cast<float>(1.0 / lidar.rate());
  msg.range_min = static_cast<float>(lidar.nearest());
  msg.range_max = static_cast<float>(lidar.farthest());
  msg.ranges = reading.ranges;
  return msg;
}

sensor_msgs::PointCloud2 cloud_msg(const sensors::Sensor& camera, const sensors::Reading& reading,
                                   int columns, const std::string& frame) {
  sensor_msgs::PointCloud2 msg;
  msg.header.stamp = navvi_types::from_ns(reading.stamp);
  msg.header.frame_id = frame;
  sensor_msgs::PointCloud2Modifier modifier(msg);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(reading.ranges.size());
  msg.width = static_cast<std::uint32_t>(columns);
  msg.height = static_cast<std::uint32_t>(reading.ranges.size()) / msg.width;
  msg.row_step = msg.width * msg.point_step;
  sensor_msgs::PointCloud2Iterator<float> x(msg, "x");
  for (std::size_t i = 0; i < reading.ranges.size(); ++i, ++x)
    for (int axis = 0; axis < 3; ++axis)
      x[axis] = std::isfinite(reading.ranges[i])
                    ? reading.ranges[i] * static_cast<float>(camera.rays()[i][axis])
                    : std::numeric_limits<float>::quiet_NaN();
  return msg;
}

geometry_msgs::TransformStamped mount_msg(const sensors::Sensor& sensor, const std::string& frame) {
  geometry_msgs::TransformStamped msg;
  msg.header.frame_id = "base_link";
  msg.child_frame_id = frame;
  const Eigen::Vector3d at = sensor.mount().translation();
  const Eigen::Quaterniond turn(sensor.mount().linear());
  msg.transform.translation.x = at.x();
  msg.transform.translation.y = at.y();
  msg.transform.translation.z = at.z();
  msg.transform.rotation.x = turn.x();
  msg.transform.rotation.y = turn.y();
  msg.transform.rotation.z = turn.z();
  msg.transform.rotation.w = turn.w();
  return msg;
}

nav_msgs::OccupancyGrid to_msg(const occupancy::Slice& slice, double floor) {
  nav_msgs::OccupancyGrid msg;
  msg.header.frame_id = "map";
  msg.info.resolution = static_cast<float>(slice.resolution);
  msg.info.width = static_cast<std::uint32_t>(slice.width);
  msg.info.height = static_cast<std::uint32_t>(slice.height);
  msg.info.origin.position.x = slice.origin.x();
  msg.info.origin.position.y = slice.origin.y();
  msg.info.origin.position.z = floor;
  msg.info.origin.orientation.w = 1.0;
  msg.data = slice.cells;
  return msg;
}

RobotSensors::RobotSensors(ros::NodeHandle& node, const setup::SimNodeConfig& config,
                           const WorldDescription& world, const occupancy::OccupancyMap& map)
    : columns_(config.camera.columns), sensors_(world) {
  const auto seed = static_cast<std::uint64_t>(config.seed);
  lidar_.emplace(config.lidar, seed);
  scan_ = node.advertise<sensor_msgs::LaserScan>("scan", 5);
  if (config.sensing == "robot") {
    camera_.emplace(config.camera, ~seed);
    points_ = node.advertise<sensor_msgs::PointCloud2>("points", 5);
  }
  bumper_ = node.advertise<std_msgs::Bool>("bumper", 10, true);
  prior_ = node.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
  prior_.publish(to_msg(occupancy::slice_of(map, world.floor_height, config.lidar.height),
                        world.floor_height));
}

std::vector<geometry_msgs::TransformStamped> RobotSensors::mounts() const {
  std::vector<geometry_msgs::TransformStamped> frames{mount_msg(*lidar_, kLidarFrame)};
  if (camera_) frames.push_back(mount_msg(*camera_, kCameraFrame));
  return frames;
}

void RobotSensors::publish(const live::Session& session) {
  const live::Snapshot& now = session.world().now();
  if (session.due(lidar_->rate()))
    scan_.publish(scan_msg(*lidar_, sensors_.look(*lidar_, now), kLidarFrame));
  if (camera_ && session.due(camera_->rate()))
    points_.publish(cloud_msg(*camera_, sensors_.look(*camera_, now), columns_, kCameraFrame));
  // A pulse a contact.
  std_msgs::Bool bumped;
  bumped.data = !now.contacts.empty();
  if (bumped.data != bumped_) bumper_.publish(bumped);
  bumped_ = bumped.data;
}

}  // namespace navvi_sim::node
