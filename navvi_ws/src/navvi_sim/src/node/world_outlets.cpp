#include "node/world_outlets.hpp"

#include <rosgraph_msgs/Clock.h>

#include <navvi_types/msg_conversion.hpp>

#include "navvi_sim/description/world_hash.hpp"
#include "navvi_sim/node/msg_conversion.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::node {

WorldOutlets::WorldOutlets(ros::NodeHandle& node, const setup::SimNodeConfig& config,
                           const WorldDescription& world, const occupancy::OccupancyMap& map,
                           const live::Session& session)
    : config_(config),
      description_(world),
      map_(map),
      session_(session),
      picture_(node, world, config.life.robot, map, session),
      record_(node, session) {
  clock_ = node.advertise<rosgraph_msgs::Clock>("clock", 10);
  odom_ = node.advertise<nav_msgs::Odometry>("odom", 10);
  octomap_ = node.advertise<octomap_msgs::Octomap>("octomap_binary", 1, true);
  obstacles_ = node.advertise<navvi_msgs::Obstacles>("navvi/obstacles", 2);
  proximity_ = node.advertise<navvi_msgs::Proximity>("navvi/proximity", 2);
  contacts_ = node.advertise<navvi_msgs::Contact>("navvi/contacts", 100);
  scenario_ = node.advertise<navvi_msgs::Scenario>("navvi/scenario", 1, true);
  drive_ = node.advertise<navvi_msgs::DriveState>("navvi/drive_state", 1, true);
}

void WorldOutlets::publish_static(const scenario::StartAndGoal& scenario,
                                  const std::vector<geometry_msgs::TransformStamped>& mounts) {
  if (!config_.life.robot.imperfections.odometry_drifts())
    static_transforms_.sendTransform(odom_msg(world().now()));
  if (!mounts.empty()) static_transforms_.sendTransform(mounts);
  octomap_.publish(to_msg(map_, ros::Time()));
  picture_.publish_standing();
  scenario_.publish(navvi_types::to_msg(navvi_types::Scenario{
      description_.name, world_hash(description_), static_cast<std::uint64_t>(config_.seed),
      scenario.goal, scenario.start, description_.floor_height,
      scenario::free_places_of(description_, map_, config_.scenario),
      setup::recipe(config_, scenario), world().now().stamp()}));
}

void WorldOutlets::publish_state() {
  const live::Snapshot& now = world().now();
  rosgraph_msgs::Clock clock;
  clock.clock = stamp();
  clock_.publish(clock);
  const navvi_types::Odometry odometry = world().odometry();
  std::vector<geometry_msgs::TransformStamped> frames{base_link_msg(odometry)};
  if (config_.life.robot.imperfections.odometry_drifts()) frames.push_back(odom_msg(now));
  transforms_.sendTransform(frames);
  odom_.publish(navvi_types::to_msg(odometry));
  for (const navvi_types::Contact& contact : now.contacts)
    contacts_.publish(navvi_types::to_msg(contact));
  if (session_.due(live::kProximityRate))
    proximity_.publish(navvi_types::to_msg(world().proximity(config_.detection_radius)));
  if (session_.due(live::kObstaclesRate)) {
    obstacles_.publish(navvi_types::to_msg(world().obstacles()));
    picture_.publish_moving();
  }
}

void WorldOutlets::publish_drive_state(const navvi_types::DriveState& drive) {
  if (drive_state_ && drive_state_->state == drive.state && drive_state_->reason == drive.reason &&
      drive_state_->rejected == drive.rejected && drive_state_->intruder == drive.intruder)
    return;
  drive_.publish(navvi_types::to_msg(drive));
  drive_state_ = drive;
}

}  // namespace navvi_sim::node
