#include "node/robot_sensors.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <limits>

namespace navvi_sim::node {
namespace {

TEST(SensorConversion, a_scan_says_where_each_of_its_rays_points) {
  for (const double field : {360.0, 270.0}) {
    sensors::LidarConfig config;
    config.field = field;
    config.rays = 271;
    const sensors::Sensor lidar(config, 1);
    sensors::Reading reading{2'500'000'000, std::vector<float>(271, 1.0F), {}};
    const sensor_msgs::LaserScan msg = scan_msg(lidar, reading, "laser");
    EXPECT_EQ(msg.header.frame_id, "laser");
    EXPECT_DOUBLE_EQ(msg.header.stamp.toSec(), 2.5);
    for (std::size_t i = 0; i < msg.ranges.size(); ++i) {
      const float angle = msg.angle_min + static_cast<float>(i) * msg.angle_increment;
      EXPECT_NEAR(std::cos(angle), lidar.rays()[i].x(), 1e-4);
      EXPECT_NEAR(std::sin(angle), lidar.rays()[i].y(), 1e-4);
    }
  }
}

TEST(SensorConversion, a_cloud_has_a_point_a_pixel_and_none_where_nothing_was_measured) {
  sensors::CameraConfig config;
  const sensors::Sensor camera(config, 1);
  sensors::Reading reading{0, std::vector<float>(camera.rays().size(), 2.0F), {}};
  reading.ranges[1] = std::numeric_limits<float>::infinity();
  const sensor_msgs::PointCloud2 msg = cloud_msg(camera, reading, config.columns, "camera_link");
  EXPECT_EQ(msg.width, 64U);
  EXPECT_EQ(msg.height, 40U);
  EXPECT_EQ(msg.data.size(), std::size_t{msg.row_step} * msg.height);
  sensor_msgs::PointCloud2ConstIterator<float> x(msg, "x");
  EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 2.0, 1e-5);
  EXPECT_GT(x[1], 0.0F) << "the first pixel is on the left";
  EXPECT_GT(x[2], 0.0F) << "and above";
  ++x;
  EXPECT_TRUE(std::isnan(x[0]));
}

TEST(SensorConversion, the_frame_of_a_camera_that_looks_down_turns_its_x_axis_down) {
  sensors::CameraConfig config;
  const auto msg = mount_msg(sensors::Sensor(config, 1), "camera_link");
  const auto& q = msg.transform.rotation;
  const Eigen::Vector3d ahead = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.z(), -std::sin(navvi_types::radians(config.pitch)), 1e-9);
  EXPECT_DOUBLE_EQ(msg.transform.translation.z, config.height);
}

}  // namespace
}  // namespace navvi_sim::node
