#include "plugin/preview.hpp"

#include <nav_msgs/GetPlan.h>

#include <chrono>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_rviz::plugin {
namespace {

constexpr double kPatience = 1.0;  // s, between two questions, while there is no path

/// \return without poses: there is no path, or no map yet
nav_msgs::Path plan(const geometry_msgs::PoseStamped& goal) {
  nav_msgs::GetPlan plan;
  plan.request.goal = goal;
  const bool works = ros::service::exists("move_base/make_plan", false) &&
                     ros::service::call("move_base/make_plan", plan);
  return works ? plan.response.plan : nav_msgs::Path();
}

}  // namespace

Preview::Preview() : path_(node_.advertise<nav_msgs::Path>("navvi/preview", 1, true)) {}

void Preview::update(const std::optional<Eigen::Vector2d>& goal) {
  if (answer_.valid()) {
    if (answer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    shown_path_ = answer_.get();
    if (!shown_path_.poses.empty() && goal) {
      path_.publish(shown_path_);
      shown_ = goal;
    }
  }
  if (shown_ && shown_ != goal) {
    shown_path_.poses.clear();
    path_.publish(shown_path_);
    shown_.reset();
  }
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!goal || shown_ || (now - asked_).toSec() < kPatience) return;
  asked_ = now;
  answer_ = std::async(std::launch::async, plan,
                       navvi_types::goal_msg(*goal, navvi_types::to_ns(ros::Time::now())));
}

}  // namespace navvi_rviz::plugin
