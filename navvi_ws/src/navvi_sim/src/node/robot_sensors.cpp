#include "node/robot_sensors.hpp"

#include <std_msgs/Bool.h>

#include "navvi_sim/node/msg_conversion.hpp"
#include "navvi_sim/occupancy/slice.hpp"

namespace navvi_sim::node {
namespace {

constexpr const char* kLidarFrame = "laser";
constexpr const char* kCameraFrame = "camera_link";

}  // namespace

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
