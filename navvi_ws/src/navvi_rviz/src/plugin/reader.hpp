#pragma once

#include <ros/ros.h>

#include <vector>

#include "status/status.hpp"

namespace navvi_rviz::plugin {

/// Keeps a Status up to date with the topics of NavVI's nodes. Callbacks run in the GUI's thread.
class Reader {
 public:
  Reader();
  [[nodiscard]] status::Shown shown();
  /// Its words are in the language of the session, once that is known; before in English.
  [[nodiscard]] const status::Status& status() const { return status_; }
  /// The goal of the trial that waits for the person to begin it, m, in map.
  [[nodiscard]] std::optional<Eigen::Vector2d> goal_ahead() const;

 private:
  void read_words();

  ros::NodeHandle node_;
  std::string phrases_;  ///< the file whose words are used
  std::string units_;    ///< of lengths
  status::Status status_;
  status::SteadyBanner banner_;
  std::optional<Eigen::Vector2d> goal_;  ///< m, in map, of the scenario
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace navvi_rviz::plugin
