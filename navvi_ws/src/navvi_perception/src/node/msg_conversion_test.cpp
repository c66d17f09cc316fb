#include "node/msg_conversion.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

#include "fuzz_message.hpp"

namespace navvi_perception::node {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

sensor_msgs::LaserScan scan() {
  sensor_msgs::LaserScan msg;
  msg.header.frame_id = "laser";
  msg.angle_increment = 0.1F;
  msg.range_min = 0.1F;
  msg.range_max = 10.0F;
  msg.ranges = {1.0F, kInf, kNan, 0.0F};
  return msg;
}

sensor_msgs::PointCloud2 cloud(const std::vector<Eigen::Vector3f>& points) {
  sensor_msgs::PointCloud2 msg;
  msg.header.frame_id = "camera";
  sensor_msgs::PointCloud2Modifier modifier(msg);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  if (points.empty()) return msg;
  sensor_msgs::PointCloud2Iterator<float> x(msg, "x");
  for (const Eigen::Vector3f& point : points) {
    for (int i = 0; i < 3; ++i) x[i] = point[i];
    ++x;
  }
  return msg;
}

/// How rays are read: '.' as measured, 'c' clear, '?' unknown.
std::string read(const std::vector<float>& ranges, bool free) {
  sensor_msgs::LaserScan msg = scan();
  msg.ranges = ranges;
  std::string words;
  for (const float range : plain(msg, free).ranges)
    words += std::isnan(range) ? '?' : std::isinf(range) ? 'c' : '.';
  return words;
}

TEST(MsgConversion, H2_reads_rays_without_a_return_as_rep_117_or_as_the_driver_means_them) {
  const std::vector<float> ranges = {1.0F, kInf, kNan, 0.0F, 10.0F, 11.0F, 65.535F, 0.05F, -kInf};
  EXPECT_EQ(read(ranges, false), ".c???????");
  EXPECT_EQ(read(ranges, true), ".cccccc??") << "what is too near is never free";
}

TEST(MsgConversion, takes_0_for_no_measurement_also_where_range_min_is_0) {
  sensor_msgs::LaserScan nearest = scan();
  nearest.range_min = 0.0F;
  nearest.ranges = {0.0F, 0.01F};
  EXPECT_TRUE(std::isnan(plain(nearest, false).ranges[0]));
  EXPECT_EQ(plain(nearest, false).ranges[1], 0.01F);
}

TEST(MsgConversion, takes_a_scan_with_rays_that_met_nothing_or_have_no_measurement) {
  const auto good = from_msg(scan());
  ASSERT_TRUE(good);
  EXPECT_LT(with_clear_rays(**good).ranges[1], 10.0F);
  EXPECT_GT(with_clear_rays(**good).ranges[1], 9.99F);
  sensor_msgs::LaserScan none = scan();
  none.ranges = {kNan, 0.0F};
  EXPECT_TRUE(from_msg(none)) << "whether it tells anything depends on what the driver means";
}

TEST(MsgConversion, says_which_value_of_a_message_is_wrong) {
  sensor_msgs::LaserScan slow = scan();
  slow.time_increment = 10.0F;
  EXPECT_NE(from_msg(slow).why().find("a sweep of 30"), std::string::npos) << from_msg(slow).why();
  sensor_msgs::PointCloud2 points = cloud({{1, 2, 3}});
  points.fields.pop_back();
  EXPECT_NE(from_msg(points).why().find("field z"), std::string::npos) << from_msg(points).why();
  nav_msgs::OccupancyGrid map;
  map.info.resolution = 5.0F;
  EXPECT_NE(from_msg(map).why().find("resolution"), std::string::npos) << from_msg(map).why();
}

TEST(MsgConversion, drops_a_scan_that_no_lidar_can_have_meant) {
  const std::vector<std::function<void(sensor_msgs::LaserScan&)>> faults = {
      [](auto& msg) { msg.header.frame_id = ""; },
      [](auto& msg) { msg.ranges.clear(); },
      [](auto& msg) { msg.ranges.assign(200'000, 1.0F); },
      [](auto& msg) { msg.angle_min = kNan; },
      [](auto& msg) { msg.angle_increment = kNan; },
      [](auto& msg) { msg.angle_increment = 3.0F; },
      [](auto& msg) { msg.range_max = kInf; },
      [](auto& msg) { msg.range_min = kNan; },
      [](auto& msg) { msg.range_min = 11.0F; },
      [](auto& msg) { msg.time_increment = kNan; },
      [](auto& msg) { msg.time_increment = 10.0F; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    sensor_msgs::LaserScan msg = scan();
    faults[i](msg);
    EXPECT_FALSE(from_msg(msg)) << i;
    EXPECT_NE(from_msg(msg).why(), "") << i;
  }
}

TEST(MsgConversion, takes_the_finite_points_of_a_cloud_and_thins_them) {
  const sensor_msgs::PointCloud2 msg =
      cloud({{1, 2, 3}, {kNan, 0, 0}, {4, 5, 6}, {7, 8, 9}, {0, kInf, 0}});
  ASSERT_TRUE(from_msg(msg));
  EXPECT_EQ(points_of(msg, 100).size(), 3U);
  EXPECT_EQ(points_of(msg, 3).size(), 2U);  // every second: the first, third and fifth
  EXPECT_EQ(points_of(msg, 3)[1], Eigen::Vector3d(4, 5, 6));
}

/// The same two rows of two points, as a driver has them.
struct Habit {
  const char* name;
  std::function<void(sensor_msgs::PointCloud2&)> have;
};

/// The message with x, y and z as Number, `extra` bytes after each row, and bytes turned round.
template <typename Number>
void rewrite(sensor_msgs::PointCloud2& msg, std::size_t extra, bool big) {
  const std::vector<Eigen::Vector3d> points = points_of(msg, 100);
  msg.data.clear();
  msg.point_step = 3 * sizeof(Number);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    msg.fields[axis].offset = static_cast<std::uint32_t>(axis * sizeof(Number));
    msg.fields[axis].datatype = sizeof(Number) == 8 ? sensor_msgs::PointField::FLOAT64
                                                    : sensor_msgs::PointField::FLOAT32;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto number = static_cast<Number>(points[i][axis]);
      std::array<std::uint8_t, sizeof(Number)> bytes{};
      std::memcpy(bytes.data(), &number, bytes.size());
      if (big) std::reverse(bytes.begin(), bytes.end());
      msg.data.insert(msg.data.end(), bytes.begin(), bytes.end());
    }
    if (i % 2 == 1) msg.data.insert(msg.data.end(), extra, 0);
  }
  msg.row_step = static_cast<std::uint32_t>(2 * msg.point_step + extra);
  msg.is_bigendian = big;
}

TEST(MsgConversion, H3_reads_clouds_as_drivers_lay_them_out) {
  const std::vector<Habit> habits = {
      {"as defined", [](auto&) {}},
      {"row_step 0", [](auto& msg) { msg.row_step = 0; }},
      {"row_step of another width", [](auto& msg) { msg.row_step /= 2; }},
      {"row_step beyond all bounds", [](auto& msg) { msg.row_step = 4'000'000'000U; }},
      {"padded rows", [](auto& msg) { rewrite<float>(msg, 40, false); }},
      {"doubles", [](auto& msg) { rewrite<double>(msg, 0, false); }},
      {"big-endian", [](auto& msg) { rewrite<float>(msg, 0, true); }},
      {"big-endian doubles in padded rows", [](auto& msg) { rewrite<double>(msg, 16, true); }},
  };
  for (const Habit& habit : habits) {
    sensor_msgs::PointCloud2 msg = cloud({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {-1, 0, 2}});
    msg.height = msg.width = 2;
    msg.row_step /= 2;
    habit.have(msg);
    ASSERT_TRUE(from_msg(msg)) << habit.name << ": " << from_msg(msg).why();
    const std::vector<Eigen::Vector3d> points = points_of(**from_msg(msg), 100);
    ASSERT_EQ(points.size(), 4U) << habit.name;
    EXPECT_EQ(points[2], Eigen::Vector3d(7, 8, 9)) << habit.name;
    EXPECT_EQ(points[3], Eigen::Vector3d(-1, 0, 2)) << habit.name;
  }
}

TEST(MsgConversion, takes_a_cloud_in_which_nothing_is_seen) {
  for (sensor_msgs::PointCloud2 msg : {cloud({}), cloud({{kNan, kNan, kNan}})}) {
    ASSERT_TRUE(from_msg(msg)) << from_msg(msg).why();
    EXPECT_TRUE(points_of(msg, 100).empty());
    msg.fields.clear();
    msg.row_step = 7;
    EXPECT_EQ(from_msg(msg).has_value(), msg.width == 0) << "no points need no fields";
  }
}

TEST(MsgConversion, takes_a_scan_none_of_whose_rays_is_a_point) {
  sensor_msgs::PointCloud2 none;
  sensor_msgs::PointCloud2Modifier modifier(none);
  constexpr auto kFloat = sensor_msgs::PointField::FLOAT32, kInt = sensor_msgs::PointField::INT32;
  modifier.setPointCloud2Fields(4, "x", 1, kFloat, "y", 1, kFloat, "z", 1, kFloat, "index", 1, kInt);
  sight::Sight sight;
  add_points(scan(), none, sight);
  EXPECT_TRUE(sight.hits.empty() && sight.clear.empty());
}

TEST(MsgConversion, drops_a_cloud_that_is_not_whole) {
  const std::vector<std::function<void(sensor_msgs::PointCloud2&)>> faults = {
      [](auto& msg) { msg.header.frame_id = ""; },
      [](auto& msg) { msg.data.pop_back(); },
      [](auto& msg) { msg.width = 4'000'000'000U; },
      [](auto& msg) { msg.height = 4'000'000'000U; },
      [](auto& msg) { msg.height = 2, msg.width = 2; },
      [](auto& msg) { msg.point_step = 4; },
      [](auto& msg) { msg.fields.pop_back(); },
      [](auto& msg) { msg.fields[2].offset = 4'000'000'000U; },
      [](auto& msg) { msg.fields[0].datatype = sensor_msgs::PointField::INT8; },
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    sensor_msgs::PointCloud2 msg = cloud({{1, 2, 3}, {4, 5, 6}});
    ASSERT_TRUE(from_msg(msg));
    faults[i](msg);
    EXPECT_FALSE(from_msg(msg)) << i;
  }
}

TEST(MsgConversion, takes_a_prior_map_that_lies_flat_and_is_whole) {
  nav_msgs::OccupancyGrid msg;
  msg.info.resolution = 0.05F;
  msg.info.width = 2;
  msg.info.height = 1;
  msg.info.origin.orientation.w = 1.0;
  msg.data = {-1, 100};
  ASSERT_TRUE(from_msg(msg));
  EXPECT_EQ(from_msg(msg)->cells, (std::vector<std::int8_t>{-1, 100}));
  msg.data = {-2, 100};
  EXPECT_FALSE(from_msg(msg));
  msg.data = {0};
  EXPECT_FALSE(from_msg(msg));
  msg.data = {0, 0};
  msg.info.origin.position.x = static_cast<double>(kNan);
  EXPECT_FALSE(from_msg(msg));
  msg.info.origin.position.x = 0.0;
  msg.info.origin.orientation.z = std::sin(0.15);
  msg.info.origin.orientation.w = std::cos(0.15);
  ASSERT_TRUE(from_msg(msg)) << from_msg(msg).why();
  EXPECT_NEAR(from_msg(msg)->yaw, 0.3, 1e-9);
  msg.info.origin.orientation.z = msg.info.origin.orientation.w = 0.0;
  ASSERT_TRUE(from_msg(msg)) << "a quaternion that was left at 0: " << from_msg(msg).why();
  EXPECT_EQ(from_msg(msg)->yaw, 0.0);
  msg.info.origin.orientation.w = 0.5;
  EXPECT_FALSE(from_msg(msg));
  msg.info.origin.orientation.w = msg.info.origin.orientation.y = std::sqrt(0.5);
  EXPECT_FALSE(from_msg(msg)) << "tilted";
}

TEST(MsgConversion, shows_what_stands_and_what_moves_and_nothing_of_before) {
  using visualization_msgs::Marker;
  navvi_types::Obstacles obstacles{5, {}};
  const auto none = seen_msg({}, 0.05, obstacles, "map").markers;
  ASSERT_EQ(none.size(), 1U);
  EXPECT_EQ(none[0].action, Marker::DELETEALL);
  navvi_types::MovingThing thing;
  thing.pose.position = {1.0, 2.0};
  thing.radius = 0.3;
  thing.height = 0.5;
  obstacles.things.push_back(thing);
  thing.velocity = {0.0, 1.0};
  obstacles.things.push_back(thing);
  const auto all = seen_msg({{1.0, 2.0, 0.1}, {1.0, 2.0, 0.15}}, 0.05, obstacles, "map").markers;
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[1].type, Marker::CUBE_LIST);
  EXPECT_EQ(all[1].points.size(), 2U);
  EXPECT_EQ(all[2].type, Marker::CYLINDER);
  EXPECT_DOUBLE_EQ(all[2].pose.position.z, 0.25);
  ASSERT_EQ(all[4].type, Marker::ARROW);
  EXPECT_DOUBLE_EQ(all[4].points[0].y, 2.3);
  EXPECT_DOUBLE_EQ(all[4].points[1].y, 3.3);
  std::set<std::pair<std::string, int>> names;
  for (const Marker& marker : all) EXPECT_TRUE(names.emplace(marker.ns, marker.id).second);
}

TEST(MsgConversion, shows_the_robot_with_its_nose_ahead) {
  const auto parts = robot_markers(0.2, 0.5, "base");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].header.frame_id, "base");
  EXPECT_TRUE(parts[0].frame_locked && parts[1].frame_locked) << "it moves between two messages";
  EXPECT_DOUBLE_EQ(parts[0].scale.x, 0.4);
  EXPECT_DOUBLE_EQ(parts[0].pose.position.z + parts[0].scale.z / 2.0, 0.5);
  ASSERT_EQ(parts[1].points.size(), 3U);
  EXPECT_DOUBLE_EQ(parts[1].points[0].x, 0.3);
  EXPECT_NE(parts[0].id, parts[1].id);
}

TEST(FuzzMessages, H2_of_sensors_are_taken_or_dropped) {
  navvi_test::fuzz_message(scan(), [](const sensor_msgs::LaserScan& msg) {
    const auto taken = from_msg(msg);
    if (!taken) return;
    EXPECT_TRUE(std::isfinite(sweep_of(**taken)));
    for (const bool free : {false, true})
      for (const float range : with_clear_rays(plain(**taken, free)).ranges)
        EXPECT_FALSE(std::isinf(range));
  });
  navvi_test::fuzz_message(cloud({{1, 2, 3}, {4, 5, 6}}), [](const sensor_msgs::PointCloud2& msg) {
    const auto taken = from_msg(msg);
    if (!taken) return;
    for (const Eigen::Vector3d& point : points_of(**taken, 100)) EXPECT_TRUE(point.allFinite());
  });
  nav_msgs::OccupancyGrid grid;
  grid.info.width = grid.info.height = 2;
  grid.info.resolution = 0.05F;
  grid.info.origin.orientation.w = 1.0;
  grid.data = {0, 100, -1, 0};
  navvi_test::fuzz_message(grid, [](const nav_msgs::OccupancyGrid& msg) {
    const auto prior = from_msg(msg);
    EXPECT_TRUE(!prior || prior->cells.size() == msg.data.size());
  });
  geometry_msgs::Transform transform;
  transform.rotation.w = 1.0;
  navvi_test::fuzz_message(transform, [](const geometry_msgs::Transform& msg) {
    const auto pose = pose_of(msg);
    EXPECT_TRUE(!pose || pose->matrix().allFinite());
  });
}

}  // namespace
}  // namespace navvi_perception::node
