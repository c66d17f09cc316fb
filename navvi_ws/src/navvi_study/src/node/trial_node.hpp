#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "trial/trial_keeper.hpp"

namespace navvi_study::node {

/// Runs trials (TrialKeeper) on what the topics say. Everything happens in the thread that spins.
class TrialNode {
 public:
  /// Puts earlier trials in order. \throws std::runtime_error if `out` cannot be used
  explicit TrialNode(const trial::TrialNodeConfig& config);

  /// Ends a running trial as aborted and closes everything. Takes two seconds at most.
  void shut_down();
  /// What the process is to return once ROS has been shut down.
  [[nodiscard]] int exit_code() const { return keeper_.exit_code(); }

 private:
  [[nodiscard]] trial::TrialKeeper::Outlets outlets();
  void subscribe(const trial::TrialNodeConfig& config);
  template <typename Message, typename Callback>
  void listen(const std::string& topic, const Callback& callback);
  /// Hands on what from_msg() makes of the messages of `topic`; bad ones are dropped and counted.
  template <typename Message>
  void take(const std::string& topic);
  void on_goal(const ros::MessageEvent<geometry_msgs::PoseStamped const>& event);
  void step();

  ros::NodeHandle node_;
  std::string recorder_name_;
  ros::Publisher events_;
  ros::Publisher goals_;
  trial::TrialKeeper keeper_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
};

}  // namespace navvi_study::node
