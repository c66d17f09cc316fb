#pragma once

#include <nav_msgs/Path.h>
#include <ros/ros.h>

#include <Eigen/Core>
#include <future>
#include <optional>

namespace navvi_rviz::plugin {

/// Asks nav_node for the path to the goal of a trial that has not begun, and publishes it for
/// feedback_node to draw: so the person can plan the way in peace. Nothing waits for the answer.
class Preview {
 public:
  Preview();
  /// \param goal  m, in map; nullopt: no trial waits
  void update(const std::optional<Eigen::Vector2d>& goal);

 private:
  ros::NodeHandle node_;
  ros::Publisher path_;
  std::optional<Eigen::Vector2d> shown_;  ///< m, in map, the goal whose path is shown
  nav_msgs::Path shown_path_;
  ros::SteadyTime asked_;
  std::future<nav_msgs::Path> answer_;
};

}  // namespace navvi_rviz::plugin
