#include "node/world_outlets.hpp"

#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <navvi_types/msg_conversion.hpp>

#include "navvi_sim/description/world_description.hpp"
#include "navvi_sim/node/msg_conversion.hpp"
#include "navvi_sim/occupancy/occupancy.hpp"

namespace navvi_sim::node {

// What moves in the picture, for a bag that RViz shows without us: seldom, that it stays small.
constexpr double kRecordedPeriod = 0.5;     // s
constexpr double kRecordedMarkers = 400.0;  // a second, at most

Picture::Picture(ros::NodeHandle& node, const WorldDescription& world,
                 const physics::RobotConfig& robot, const occupancy::OccupancyMap& map,
                 const live::Session& session)
    : session_(session), looks_(world, robot) {
  // Large and seldom looked at: made for each subscriber.
  cells_ = node.advertise<visualization_msgs::MarkerArray>(
      "occupied_cells_vis_array", 1, [this, &map](const ros::SingleSubscriberPublisher& listener) {
        listener.publish(occupied_cells_msg(map, stamp()));
      });
  standing_ = node.advertise<visualization_msgs::MarkerArray>("navvi/scene", 1, true);
  moving_ = node.advertise<visualization_msgs::MarkerArray>("navvi/scene_moving", 1);
  recorded_ = node.advertise<visualization_msgs::MarkerArray>("navvi/scene_recorded", 1);
}

void Picture::publish_standing() { standing_.publish(looks_.standing(stamp())); }

void Picture::publish_moving() {
  const live::Snapshot& now = session_.world().now();
  const visualization_msgs::MarkerArray& scene = looks_.moving(now, stamp());
  moving_.publish(scene);
  if (now.time < next_recorded_) return;
  recorded_.publish(scene);
  const auto markers = static_cast<double>(scene.markers.size());
  next_recorded_ = now.time + std::max(kRecordedPeriod, markers / kRecordedMarkers);
}

RepetitionRecord::RepetitionRecord(ros::NodeHandle& node, const live::Session& session)
    : session_(session) {
  // A subscriber that comes in mid-session can still repeat it from its first step.
  applied_ = node.advertise<navvi_msgs::AppliedCommands>(
      "navvi/applied_commands", 1000, [this](const ros::SingleSubscriberPublisher& listener) {
        listener.publish(applied_commands_msg(session_.commands(), 0, stamp()));
      });
  hash_ = node.advertise<navvi_msgs::StateHash>("navvi/state_hash", 1, true);
}

void RepetitionRecord::publish() {
  if (commands_published_ < session_.commands().size()) {
    applied_.publish(applied_commands_msg(session_.commands(), commands_published_, stamp()));
    commands_published_ = session_.commands().size();
  }
  if (hashes_published_ < session_.hashes().size()) {
    hash_.publish(navvi_types::to_msg(session_.hashes().back()));
    hashes_published_ = session_.hashes().size();
  }
}

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
      scenario::free_places_of(description_, occupancy::voxels_of(map_), config_.scenario),
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
      drive_state_->rejected == drive.rejected && drive_state_->intruder == drive.intruder &&
      drive_state_->assistance == drive.assistance)
    return;
  drive_.publish(navvi_types::to_msg(drive));
  drive_state_ = drive;
}

}  // namespace navvi_sim::node
