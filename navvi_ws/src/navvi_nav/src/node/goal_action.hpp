#pragma once

#include <actionlib/server/simple_action_server.h>
#include <geometry_msgs/PoseStamped.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <navvi_msgs/Guidance.h>

#include <functional>
#include <string>

namespace navvi_nav::node {

/// The goal as an action, by move_base's name and type, for programs that expect one. Nothing drives
/// to it but the person, who is led there and takes the time they need.
class GoalAction {
 public:
  /// \param set_goal  as from the topic of goals, in map if its frame is known \param cancel_goal  of the action
  GoalAction(const ros::NodeHandle& node,
             std::function<void(geometry_msgs::PoseStamped&)> set_goal,
             std::function<void()> cancel_goal);

  /// A goal of the topic to which it leads now: the action's, or one that takes its place.
  void take(const geometry_msgs::PoseStamped& goal);
  /// A goal of the topic that is dropped. \param why  for the client, if it is the action's
  void drop(const geometry_msgs::PoseStamped& goal, const std::string& why);
  /// Each guidance that is published. \param robot  as it is now
  void report(const navvi_msgs::Guidance& guidance, const geometry_msgs::PoseStamped& robot);

 private:
  void accept();
  void cancel();
  [[nodiscard]] bool own(const geometry_msgs::PoseStamped& goal) const {
    return goal.header.frame_id == goal_.header.frame_id &&
           goal.pose.position == goal_.pose.position;
  }

  std::function<void(geometry_msgs::PoseStamped&)> set_goal_;
  std::function<void()> cancel_goal_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server_;
  geometry_msgs::PoseStamped goal_;
  bool taken_ = false;  ///< the topic has brought it
};

}  // namespace navvi_nav::node
