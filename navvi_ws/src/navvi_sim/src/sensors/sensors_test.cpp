#include "navvi_sim/sensors/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace navvi_sim::sensors {
namespace {

Thing thing(const std::string& name, const Eigen::Vector3d& at, const Geometry& geometry) {
  Thing out;
  out.name = name;
  out.thing_class = ThingClass::box;
  out.pose.translation() = at;
  out.shapes = {{geometry}};
  return out;
}

/// A wall 3 m ahead, a cylinder 2 m to the left, a pedestal of 0.10 m 1.5 m to the right, a plate
/// 1 m behind, 1 m above the floor, and a mover 5 m behind.
WorldDescription hall(double floor) {
  WorldDescription world{"hall", floor, {}, {}};
  const Eigen::Vector3d up(0.0, 0.0, floor);
  world.things = {thing("wall", up + Eigen::Vector3d(3.1, 0.0, 1.0), Box{{0.2, 8.0, 2.0}}),
                  thing("pillar", up + Eigen::Vector3d(0.0, 2.3, 1.0), Cylinder{0.3, 2.0}),
                  thing("pedestal", up + Eigen::Vector3d(0.0, -2.0, 0.05), Box{{1.0, 1.0, 0.10}}),
                  thing("plate", up + Eigen::Vector3d(-1.5, 0.0, 1.0), Box{{1.0, 1.0, 0.1}}),
                  thing("mover", up + Eigen::Vector3d(-5.3, 0.0, 0.5), Sphere{0.5})};
  world.things[4].thing_class = ThingClass::pallet_robot;
  world.things[4].route = Route{{{{-5.3, 0.0}}, {{-5.3, 3.0}}}};
  return world;
}

struct At {
  explicit At(double floor = 0.0) : world(hall(floor)), sensors(world) {
    live::WorldConfig config;
    now = live::World(world, config, Pose2{}, 1).now();
  }
  WorldDescription world;
  Sensors sensors;
  live::Snapshot now;
};

LidarConfig exact() {
  LidarConfig config;
  config.noise = config.dropouts = 0.0;
  return config;
}

/// Index of the ray of a lidar of 360 rays at so many degrees.
std::size_t ray(int degrees) { return static_cast<std::size_t>(degrees + 180); }

TEST(Sensors, a_lidar_measures_what_is_in_its_plane_to_a_millimetre) {
  for (const double floor : {0.0, 1.7}) {
    At at(floor);
    Sensor lidar(exact(), 1);
    const Reading scan = at.sensors.look(lidar, at.now);
    ASSERT_EQ(scan.ranges.size(), 360U);
    EXPECT_NEAR(scan.ranges[ray(0)], 3.0, 1e-3);
    EXPECT_NEAR(scan.ranges[ray(30)], 3.0 / std::cos(kPi / 6.0), 1e-3);
    EXPECT_NEAR(scan.ranges[ray(90)], 2.0, 1e-3);
    EXPECT_TRUE(std::isinf(scan.ranges[ray(-90)])) << "the pedestal is below the plane";
    EXPECT_EQ(scan.movers[ray(0)], Reading::kNoMover);
    EXPECT_EQ(scan.movers[ray(-180)], 4U) << "below the plate";
    EXPECT_NEAR(scan.ranges[ray(-180)], 5.3 - std::sqrt(0.25 - 0.38 * 0.38), 3e-3);
  }
}

TEST(Sensors, a_ray_turns_with_the_robot_and_meets_a_mover_where_it_is_now) {
  At at;
  at.now.robot.yaw = kPi / 2.0;
  at.now.robot.position = {1.0, 0.0};
  at.now.movers[0].pose.translation() += Eigen::Vector3d(0.0, 3.0, 0.0);
  Sensor lidar(exact(), 1);
  const Reading scan = at.sensors.look(lidar, at.now);
  EXPECT_NEAR(scan.ranges[ray(-90)], 2.0, 1e-3);
  EXPECT_TRUE(std::isinf(scan.ranges[ray(90)]));
}

TEST(Sensors, a_lidar_of_270_degrees_is_blind_behind) {
  At at;
  LidarConfig config = exact();
  config.field = 270.0;
  config.rays = 271;
  Sensor lidar(config, 1);
  const Reading scan = at.sensors.look(lidar, at.now);
  EXPECT_NEAR(scan.ranges[135], 3.0, 1e-3);
  EXPECT_NEAR(scan.ranges[225], 2.0, 1e-3);
  for (const std::uint32_t mover : scan.movers) EXPECT_EQ(mover, Reading::kNoMover);
}

TEST(Sensors, noise_and_drop_outs_are_as_large_as_said_and_drawn_from_the_seed) {
  At at;
  LidarConfig config;
  config.noise = 0.02;
  config.dropouts = 0.1;
  Sensor lidar(config, 5), same(config, 5), other(config, 6);
  int rays = 0, lost = 0;
  double squares = 0.0;
  bool differs = false;
  for (int i = 0; i < 200; ++i) {
    const Reading scan = at.sensors.look(lidar, at.now);
    const Reading again = at.sensors.look(same, at.now);
    differs = differs || at.sensors.look(other, at.now).ranges[ray(0)] != scan.ranges[ray(0)];
    for (int degrees = -40; degrees <= 40; ++degrees) {
      const double range = static_cast<double>(scan.ranges[ray(degrees)]);
      ++rays;
      if (std::isnan(range)) {
        ++lost;
        EXPECT_TRUE(std::isnan(again.ranges[ray(degrees)]));
        continue;
      }
      EXPECT_EQ(again.ranges[ray(degrees)], scan.ranges[ray(degrees)]);
      squares += std::pow(range - 3.0 / std::cos(navvi_types::radians(degrees)), 2);
    }
  }
  EXPECT_TRUE(differs);
  EXPECT_NEAR(static_cast<double>(lost) / rays, 0.1, 0.01);
  EXPECT_NEAR(std::sqrt(squares / (rays - lost)), 0.02, 0.001);
}

TEST(Sensors, a_camera_sees_the_floor_and_a_pedestal_on_it) {
  At at;
  at.now.robot.yaw = -kPi / 2.0;
  CameraConfig config;
  config.noise = config.dropouts = 0.0;
  Sensor camera(config, 1);
  const Reading picture = at.sensors.look(camera, at.now);
  ASSERT_EQ(picture.ranges.size(), 64U * 40U);
  double highest = -1.0, lowest = 1.0;
  int of_pedestal = 0;
  for (std::size_t i = 0; i < picture.ranges.size(); ++i) {
    if (!std::isfinite(picture.ranges[i])) continue;
    const Eigen::Vector3d point =
        camera.mount() * (static_cast<double>(picture.ranges[i]) * camera.rays()[i]);
    lowest = std::min(lowest, point.z());
    if (std::abs(point.y()) > 0.49) continue;
    highest = std::max(highest, point.z());
    if (point.z() <= 0.01) continue;
    ++of_pedestal;
    EXPECT_GT(point.x(), 1.499);
  }
  EXPECT_NEAR(lowest, 0.0, 1e-3);
  EXPECT_NEAR(highest, 0.10, 1e-3);
  EXPECT_GT(of_pedestal, 50);
}

}  // namespace
}  // namespace navvi_sim::sensors
