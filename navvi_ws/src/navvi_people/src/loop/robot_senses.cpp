#include "navvi_people/loop/robot_senses.hpp"

#include <cmath>
#include <navvi_sim/occupancy/slice.hpp>

namespace navvi_people::loop {
namespace {

constexpr double kProximityRate = 20.0;  // Hz, as perception_node's

navvi_perception::sight::Prior prior_of(const navvi_sim::occupancy::OccupancyMap& map, double floor,
                                        double height) {
  const navvi_sim::occupancy::Slice slice = slice_of(map, floor, height);
  return {slice.resolution, slice.origin, slice.width, slice.height, slice.cells};
}

navvi_perception::sight::Sight sight_of(const navvi_sim::sensors::Sensor& sensor,
                                        const navvi_sim::sensors::Reading& reading,
                                        const navvi_types::Pose2& robot, double floor) {
  const Eigen::Isometry3d eye =
      Eigen::Translation3d(robot.position.x(), robot.position.y(), floor) *
      Eigen::Isometry3d(Eigen::AngleAxisd(robot.yaw, Eigen::Vector3d::UnitZ())) * sensor.mount();
  navvi_perception::sight::Sight sight;
  sight.stamp = reading.stamp;
  sight.robot = robot;
  sight.origin = eye.translation();
  for (std::size_t i = 0; i < reading.ranges.size(); ++i) {
    const double range = static_cast<double>(reading.ranges[i]);
    if (std::isnan(range)) continue;
    const bool nothing = std::isinf(range);
    (nothing ? sight.clear : sight.hits)
        .push_back(eye * ((nothing ? sensor.farthest() : range) * sensor.rays()[i]));
  }
  return sight;
}

}  // namespace

RobotSenses::RobotSenses(const navvi_sim::setup::SimNodeConfig& config,
                         const navvi_perception::see::PerceptionConfig& perception,
                         const navvi_sim::WorldDescription& world,
                         const navvi_sim::occupancy::OccupancyMap& map)
    : resolution_(perception.resolution()),
      sensors_(world),
      perception_(perception, prior_of(map, world.floor_height, config.lidar.height)) {
  const auto seed = static_cast<std::uint64_t>(config.seed);
  mounted_.emplace_back(config.lidar, seed);
  if (config.sensing == "robot") mounted_.emplace_back(config.camera, ~seed);
}

RobotSenses::News RobotSenses::look(const navvi_sim::live::Session& session) {
  const navvi_sim::live::Snapshot& now = session.world().now();
  const navvi_types::Pose2 robot{now.robot.position, now.robot.yaw};
  const double floor = session.world().odometry().floor;
  News news;
  for (std::size_t i = 0; i < mounted_.size(); ++i) {
    if (!session.due(mounted_[i].rate())) continue;
    navvi_sim::sensors::Reading reading = sensors_.look(mounted_[i], now);
    navvi_perception::sight::Sight sight = sight_of(mounted_[i], reading, robot, floor);
    sight.sensor = i;
    sight.in_plane = i == 0;
    perception_.take(sight);
    if (i == 0) scan_ = std::move(reading);
    news.obstacles = perception_.obstacles(now.stamp());
  }
  if (news.obstacles) news.map = perception_.map(now.stamp());
  if (session.due(kProximityRate)) news.proximity = perception_.proximity(robot, now.stamp());
  if (!now.contacts.empty()) news.contacts = {perception_.bump(robot, ++bumps_, now.stamp())};
  return news;
}

}  // namespace navvi_people::loop
