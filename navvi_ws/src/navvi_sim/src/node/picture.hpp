#pragma once

#include <ros/ros.h>

#include "navvi_sim/live/session.hpp"
#include "navvi_sim/occupancy/occupancy_map.hpp"
#include "navvi_sim/scene/scene.hpp"

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

}  // namespace navvi_sim::node
