#include "navvi_sim/node/state_conversion.hpp"

#include <charconv>
#include <cmath>

#include "navvi_sim/description/world_hash.hpp"

namespace navvi_sim::node {
namespace {

std_msgs::Header header(const char* frame, const ros::Time& stamp) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = stamp;
  return header;
}

geometry_msgs::Pose pose_msg(const Eigen::Vector2d& position, double z, double yaw) {
  geometry_msgs::Pose pose;
  pose.position.x = position.x();
  pose.position.y = position.y();
  pose.position.z = z;
  pose.orientation.z = std::sin(0.5 * yaw);
  pose.orientation.w = std::cos(0.5 * yaw);
  return pose;
}

geometry_msgs::Point point_msg(const Eigen::Vector3d& point) {
  geometry_msgs::Point msg;
  msg.x = point.x();
  msg.y = point.y();
  msg.z = point.z();
  return msg;
}

geometry_msgs::TransformStamped transform_msg(const char* frame, const char* child,
                                              const geometry_msgs::Pose& pose,
                                              const ros::Time& stamp) {
  geometry_msgs::TransformStamped msg;
  msg.header = header(frame, stamp);
  msg.child_frame_id = child;
  msg.transform.translation.x = pose.position.x;
  msg.transform.translation.y = pose.position.y;
  msg.transform.translation.z = pose.position.z;
  msg.transform.rotation = pose.orientation;
  return msg;
}

}  // namespace

nav_msgs::Odometry odometry_msg(const physics::RobotState& odometry, double floor_height,
                                const ros::Time& stamp) {
  nav_msgs::Odometry msg;
  msg.header = header("odom", stamp);
  msg.child_frame_id = "base_link";
  msg.pose.pose = pose_msg(odometry.position, floor_height, odometry.yaw);
  msg.twist.twist.linear.x = odometry.forward_speed();
  msg.twist.twist.linear.y = odometry.sideways_speed();
  msg.twist.twist.angular.z = odometry.turn_rate;
  return msg;
}

geometry_msgs::TransformStamped base_link_msg(const physics::RobotState& odometry,
                                              double floor_height, const ros::Time& stamp) {
  return transform_msg("odom", "base_link", pose_msg(odometry.position, floor_height, odometry.yaw),
                       stamp);
}

geometry_msgs::TransformStamped odom_msg(const physics::RobotState& robot,
                                         const physics::RobotState& odometry,
                                         const ros::Time& stamp) {
  const double yaw = robot.yaw - odometry.yaw;
  const Eigen::Vector2d origin =
      robot.position - Eigen::Rotation2Dd(yaw).toRotationMatrix() * odometry.position;
  return transform_msg("map", "odom", pose_msg(origin, 0.0, yaw), stamp);
}

navvi_msgs::Obstacles obstacles_msg(const WorldDescription& world, const live::Snapshot& now,
                                    const ros::Time& stamp) {
  navvi_msgs::Obstacles msg;
  msg.header = header("map", stamp);
  msg.obstacles.reserve(now.movers.size());
  for (const MoverState& mover : now.movers) {
    navvi_msgs::Obstacle& obstacle = msg.obstacles.emplace_back();
    obstacle.id = static_cast<std::uint32_t>(mover.thing);
    obstacle.thing_class = to_string(world.things[mover.thing].thing_class);
    obstacle.pose = pose_msg(mover.pose.translation().head<2>(), world.floor_height, mover.yaw);
    obstacle.velocity.x = mover.velocity.x();
    obstacle.velocity.y = mover.velocity.y();
    obstacle.radius = mover.extent.radius;
    obstacle.height = mover.height;
    obstacle.length = mover.extent.length;
    obstacle.width = mover.extent.width;
  }
  return msg;
}

navvi_msgs::Proximity proximity_msg(const WorldDescription& world, const physics::RobotState& robot,
                                    const std::vector<physics::NearThing>& things,
                                    double detection_radius, const ros::Time& stamp) {
  navvi_msgs::Proximity msg;
  msg.header = header("base_link", stamp);
  msg.detection_radius = detection_radius;
  Eigen::Isometry3d base_link = Eigen::Isometry3d::Identity();
  base_link.translate(Eigen::Vector3d(robot.position.x(), robot.position.y(), world.floor_height));
  base_link.rotate(Eigen::AngleAxisd(robot.yaw, Eigen::Vector3d::UnitZ()));
  for (const physics::NearThing& near : things) {
    const Thing& thing = world.things[near.thing];
    navvi_msgs::ProximityThing entry;
    entry.id = static_cast<std::uint32_t>(near.thing);
    entry.name = thing.name;
    entry.thing_class = to_string(thing.thing_class);
    entry.moving = thing.route.has_value();
    entry.gap = near.gap;
    entry.nearest = point_msg(base_link.inverse() * near.nearest);
    msg.things.push_back(entry);
  }
  return msg;
}

navvi_msgs::Contact contact_msg(const WorldDescription& world, const physics::RobotState& robot,
                                const physics::ContactEvent& contact, const ros::Time& stamp) {
  const Thing& thing = world.things[contact.thing];
  navvi_msgs::Contact msg;
  msg.header = header("map", stamp);
  msg.seq = contact.seq;
  msg.id = static_cast<std::uint32_t>(contact.thing);
  msg.name = thing.name;
  msg.thing_class = to_string(thing.thing_class);
  msg.point = point_msg(contact.point);
  msg.robot = pose_msg(robot.position, world.floor_height, robot.yaw);
  msg.speed = contact.speed;
  for (const auto& [thing_class, count] : contact.counts) {
    navvi_msgs::ClassCount entry;
    entry.thing_class = to_string(thing_class);
    entry.count = count;
    msg.counts.push_back(entry);
  }
  return msg;
}

navvi_msgs::Scenario scenario_msg(const WorldDescription& world, const std::string& world_hash,
                                  std::uint64_t seed, const scenario::Scenario& scenario,
                                  const ros::Time& stamp) {
  navvi_msgs::Scenario msg;
  msg.header = header("map", stamp);
  msg.world = world.name;
  msg.world_hash = world_hash;
  msg.seed = seed;
  msg.start =
      pose_msg({scenario.start.x, scenario.start.y}, world.floor_height, scenario.start.yaw);
  msg.goal = point_msg(Eigen::Vector3d(scenario.goal.x(), scenario.goal.y(), world.floor_height));
  return msg;
}

navvi_msgs::AppliedCommands applied_commands_msg(const std::vector<live::AppliedCommand>& commands,
                                                 std::size_t first, const ros::Time& stamp) {
  navvi_msgs::AppliedCommands msg;
  msg.header = header("base_link", stamp);
  msg.first = static_cast<std::uint32_t>(first);
  for (std::size_t i = first; i < commands.size(); ++i) {
    navvi_msgs::AppliedCommand entry;
    entry.step = commands[i].step;
    entry.linear = commands[i].velocity.linear;
    entry.angular = commands[i].velocity.angular;
    entry.braking = commands[i].braking == physics::Braking::emergency;
    msg.commands.push_back(entry);
  }
  return msg;
}

navvi_msgs::StateHash state_hash_msg(const live::StateHash& state, const ros::Time& stamp) {
  navvi_msgs::StateHash msg;
  msg.header = header("map", stamp);
  msg.step = state.step;
  msg.hash = to_hex(state.hash);
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

std::optional<live::StateHash> from_msg(const navvi_msgs::StateHash& msg) {
  live::StateHash state;
  state.step = msg.step;
  const char* end = msg.hash.data() + msg.hash.size();
  const auto [rest, error] = std::from_chars(msg.hash.data(), end, state.hash, 16);
  if (msg.hash.size() != 16 || msg.hash[0] == '-' || error != std::errc() || rest != end)
    return std::nullopt;
  return state;
}

}  // namespace navvi_sim::node
