#include "node/sensor_conversion.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_sim::node {

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

}  // namespace navvi_sim::node
