#pragma once

#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstddef>
#include <navvi_types/drive_state.hpp>
#include <optional>
#include <vector>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"
#include "navvi_sim/scenario/scenario.hpp"
#include "navvi_sim/scene/scene.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"

namespace navvi_sim::node {

/// The topics by which RViz shows the world.
class Picture {
 public:
  /// \param map, session  outlive this
  Picture(ros::NodeHandle& node, const WorldDescription& world, const physics::RobotConfig& robot,
          const occupancy::OccupancyMap& map, const live::Session& session);

  /// What stands still: once.
  void publish_standing();
  /// What moves.
  void publish_moving();

 private:
  [[nodiscard]] ros::Time stamp() const { return ros::Time(session_.world().now().time); }

  const live::Session& session_;
  scene::Scene looks_;
  ros::Publisher cells_, standing_, moving_, recorded_;
  double next_recorded_ = 0.0;  ///< s, of the simulation
};

/// The topics that repeat this world, and that prove that the repetition is the same.
class RepetitionRecord {
 public:
  /// \param session  outlives this
  RepetitionRecord(ros::NodeHandle& node, const live::Session& session);

  /// What is new since the last call.
  void publish();

 private:
  [[nodiscard]] ros::Time stamp() const { return ros::Time(session_.world().now().time); }

  const live::Session& session_;
  ros::Publisher applied_, hash_;
  std::size_t commands_published_ = 0;
  std::size_t hashes_published_ = 0;
};

/// The topics and transforms by which sim_node tells its world; a robot's sensors are beside it.
class WorldOutlets {
 public:
  /// \param config, world, map, session  outlive this
  WorldOutlets(ros::NodeHandle& node, const setup::SimNodeConfig& config,
               const WorldDescription& world, const occupancy::OccupancyMap& map,
               const live::Session& session);

  /// Once. \param mounts  of the robot's sensors
  void publish_static(const scenario::StartAndGoal& scenario,
                      const std::vector<geometry_msgs::TransformStamped>& mounts);
  /// After each step.
  void publish_state();
  /// If it has changed.
  void publish_drive_state(const navvi_types::DriveState& drive);
  /// What is new for a repetition.
  void publish_record() { record_.publish(); }

 private:
  [[nodiscard]] const live::World& world() const { return session_.world(); }
  [[nodiscard]] ros::Time stamp() const { return ros::Time(world().now().time); }

  const setup::SimNodeConfig& config_;
  const WorldDescription& description_;
  const occupancy::OccupancyMap& map_;
  const live::Session& session_;
  ros::Publisher clock_, odom_, octomap_, obstacles_, proximity_, contacts_, scenario_, drive_;
  Picture picture_;
  RepetitionRecord record_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  std::optional<navvi_types::DriveState> drive_state_;  ///< last published
};

}  // namespace navvi_sim::node
