#include "navvi_sim/node/msg_conversion.hpp"

#include <cmath>
#include <map>
#include <navvi_types/msg_conversion.hpp>
#include <utility>

#include "scene/painter.hpp"

namespace navvi_sim::node {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

octomap_msgs::Octomap to_msg(const occupancy::OccupancyMap& map, const ros::Time& stamp) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = "map";
  msg.header.stamp = stamp;
  msg.binary = true;
  msg.id = "OcTree";
  msg.resolution = map.resolution();
  msg.data = map.stream();
  return msg;
}

namespace {

geometry_msgs::TransformStamped transform_msg(const char* frame, const char* child,
                                              const Pose2& pose, double z, std::int64_t stamp) {
  geometry_msgs::TransformStamped msg;
  msg.header.frame_id = frame;
  msg.header.stamp = navvi_types::from_ns(stamp);
  msg.child_frame_id = child;
  msg.transform.translation.x = pose.position.x();
  msg.transform.translation.y = pose.position.y();
  msg.transform.translation.z = z;
  msg.transform.rotation.z = std::sin(0.5 * pose.yaw);
  msg.transform.rotation.w = std::cos(0.5 * pose.yaw);
  return msg;
}

/// voxels, the least side of cubes of which for_each_cube visits `most` at most.
int finest_of(const occupancy::OccupancyMap& map, std::size_t most) {
  // Nodes by their side.
  std::vector<std::size_t> whole(occupancy::OccupancyMap::kCenter + 1),
      partial(occupancy::OccupancyMap::kCenter + 1);
  map.for_each_node([&](const occupancy::OccupiedCube& cube, bool is_whole) {
    ++(is_whole ? whole : partial)[static_cast<std::size_t>(cube.side)];
  });
  std::size_t cubes = 0;
  int finest = occupancy::OccupancyMap::kCenter;
  for (int side = occupancy::OccupancyMap::kCenter; side > 0; side /= 2) {
    cubes += whole[static_cast<std::size_t>(side)];
    if (cubes + partial[static_cast<std::size_t>(side)] <= most) finest = side;
  }
  return finest;
}

}  // namespace

MarkerArray occupied_cells_msg(const occupancy::OccupancyMap& map, const ros::Time& stamp,
                               std::size_t most) {
  constexpr scene::Color kVoxel{0.35F, 0.38F, 0.42F};
  MarkerArray array;
  std::map<int, std::size_t> depths;  // by side
  for (int depth = 0; depth <= occupancy::OccupancyMap::kDepth; ++depth) {
    const int side = 1 << (occupancy::OccupancyMap::kDepth - depth);
    depths[side] = array.markers.size();
    Marker msg = scene::marker_msg("map", depth, Marker::CUBE_LIST, kVoxel,
                                   Eigen::Vector3d::Constant(side * map.resolution()));
    msg.header.stamp = stamp;
    msg.action = Marker::DELETE;
    array.markers.push_back(std::move(msg));
  }
  map.for_each_cube(
      [&](const occupancy::OccupiedCube& cube) {
        Marker& msg = array.markers[depths.at(cube.side)];
        const auto centre = [&](int low) { return (low + 0.5 * cube.side) * map.resolution(); };
        msg.action = Marker::ADD;
        msg.points.push_back(scene::point_msg({centre(cube.x), centre(cube.y), centre(cube.z)}));
      },
      finest_of(map, most));
  return array;
}

geometry_msgs::TransformStamped base_link_msg(const navvi_types::Odometry& odometry) {
  return transform_msg("odom", "base_link", odometry.pose, odometry.floor, odometry.stamp);
}

geometry_msgs::TransformStamped odom_msg(const live::Snapshot& now) {
  const double yaw = now.robot.yaw - now.odometry.yaw;
  const Eigen::Vector2d origin =
      now.robot.position - Eigen::Rotation2Dd(yaw).toRotationMatrix() * now.odometry.position;
  return transform_msg("map", "odom", {origin, yaw}, 0.0, now.stamp());
}

navvi_msgs::AppliedCommands applied_commands_msg(const std::vector<live::AppliedCommand>& commands,
                                                 std::size_t first, const ros::Time& stamp) {
  navvi_msgs::AppliedCommands msg;
  msg.header.frame_id = "base_link";
  msg.header.stamp = stamp;
  msg.first = static_cast<std::uint32_t>(first);
  for (std::size_t i = first; i < commands.size(); ++i) {
    navvi_msgs::AppliedCommand& entry = msg.commands.emplace_back();
    entry.step = commands[i].step;
    entry.linear = commands[i].velocity.linear;
    entry.angular = commands[i].velocity.angular;
    entry.braking = commands[i].braking == physics::Braking::emergency;
  }
  return msg;
}

bool append(const navvi_msgs::AppliedCommands& msg, std::vector<live::AppliedCommand>& commands) {
  if (msg.first > commands.size()) return false;
  std::vector<live::AppliedCommand> whole = commands;
  for (std::size_t i = commands.size() - msg.first; i < msg.commands.size(); ++i) {
    const navvi_msgs::AppliedCommand& entry = msg.commands[i];
    if (!std::isfinite(entry.linear) || !std::isfinite(entry.angular)) return false;
    if (!whole.empty() && entry.step <= whole.back().step) return false;
    whole.push_back({entry.step,
                     {entry.linear, entry.angular},
                     entry.braking ? physics::Braking::emergency : physics::Braking::normal});
  }
  commands = std::move(whole);
  return true;
}

}  // namespace navvi_sim::node
