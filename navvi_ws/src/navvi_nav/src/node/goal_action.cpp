#include "node/goal_action.hpp"

#include <navvi_types/msg_conversion.hpp>
#include <utility>

namespace navvi_nav::node {

GoalAction::GoalAction(const ros::NodeHandle& node,
                       std::function<void(geometry_msgs::PoseStamped&)> set_goal,
                       std::function<void()> cancel_goal)
    : set_goal_(std::move(set_goal)),
      cancel_goal_(std::move(cancel_goal)),
      server_(node, "move_base", false) {
  server_.registerGoalCallback([this] { accept(); });
  server_.registerPreemptCallback([this] { cancel(); });
  server_.start();
}

void GoalAction::accept() {
  goal_ = server_.acceptNewGoal()->target_pose;
  taken_ = false;
  if (!navvi_types::from_msg(goal_)) return server_.setAborted({}, "the goal is not a finite point");
  set_goal_(goal_);
}

void GoalAction::cancel() {
  // A goal that replaces another one is on its way to accept().
  if (!server_.isActive() || server_.isNewGoalAvailable()) return;
  server_.setPreempted({}, "canceled");
  cancel_goal_();
}

void GoalAction::take(const geometry_msgs::PoseStamped& goal) {
  if (!server_.isActive()) return;
  if (own(goal))
    taken_ = true;
  else
    server_.setPreempted({}, "another goal was set");
}

void GoalAction::drop(const geometry_msgs::PoseStamped& goal, const std::string& why) {
  if (server_.isActive() && !taken_ && own(goal)) server_.setAborted({}, why);
}

void GoalAction::report(const navvi_msgs::Guidance& guidance,
                        const geometry_msgs::PoseStamped& robot) {
  using navvi_msgs::Guidance;
  if (!server_.isActive() || !taken_) return;
  if (guidance.state == Guidance::ARRIVED) return server_.setSucceeded({}, "arrived");
  if (guidance.state == Guidance::GOAL_REFUSED) return server_.setAborted({}, guidance.detail);
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position = robot;
  server_.publishFeedback(feedback);
}

}  // namespace navvi_nav::node
