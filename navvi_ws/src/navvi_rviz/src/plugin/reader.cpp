#include "plugin/reader.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <navvi_msgs/TrialEvent.h>
#include <ros/package.h>

#include <navvi_config/reader.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>

namespace navvi_rviz::plugin {

using navvi_types::from_msg;
using navvi_types::subscribe;

namespace {

double now() { return ros::SteadyTime::now().toSec(); }

}  // namespace

Reader::Reader() {
  const auto keep = [this](ros::Subscriber subscriber) { subscribers_.push_back(subscriber); };
  const auto take = [this](const auto& value) { status_.take(value); };
  keep(subscribe<navvi_msgs::Cue>(node_, "navvi/cues", 100, from_msg,
                                  [this](const auto& cue) { status_.take(cue, now()); }));
  keep(subscribe<navvi_msgs::Cue>(node_, "navvi/order", 1, from_msg,
                                  [this](const auto& order) { status_.take_order(order); }));
  keep(subscribe<navvi_msgs::Guidance>(node_, "navvi/guidance", 1, from_msg,
                                       [this](const auto& one) { status_.take(one, now()); }));
  keep(subscribe<navvi_msgs::DriveState>(node_, "navvi/drive_state", 1, from_msg, take));
  keep(subscribe<navvi_msgs::TrialState>(node_, "navvi/trial_state", 1, from_msg, take));
  keep(subscribe<nav_msgs::Odometry>(node_, "odom", 1, from_msg, [this](const auto& odometry) {
    status_.take_speed(odometry.velocity.linear, now());
  }));
  keep(subscribe<navvi_msgs::Scenario>(node_, "navvi/scenario", 1, from_msg,
                                       [this](const auto& scenario) { goal_ = scenario.goal; }));
  keep(node_.subscribe<navvi_msgs::TrialEvent>(
      "navvi/events", 100, [this](const navvi_msgs::TrialEvent::ConstPtr& event) {
        status_.take_event(event->type, event->header.stamp.toSec());
      }));
  keep(node_.subscribe<diagnostic_msgs::DiagnosticArray>(
      "diagnostics", 10, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
        for (const auto& device : array->status)
          for (const auto& pair : device.values)
            if (pair.key == "state")
              status_.take_device(device.name, pair.value, now());
            else if (pair.key == "input")
              status_.take_input(pair.value);
      }));
  read_words();
}

void Reader::read_words() {
  std::string file = ros::package::getPath("navvi_feedback") + "/config/phrases/en.yaml";
  ros::param::getCached("navvi/phrases", file);
  std::string units = "meters";
  ros::param::getCached("navvi/units", units);
  const bool same = file == phrases_ && units == units_;
  phrases_ = file;
  units_ = units;
  if (same) return;
  try {
    status_.use(status::Words(file, units));
  } catch (const navvi_config::ConfigError& error) {
    ROS_WARN("The picture keeps its words: %s", error.what());
  }
}

std::optional<Eigen::Vector2d> Reader::goal_ahead() const {
  const bool led = status_.guidance() && status_.guidance()->leads();
  std::string job;  // leads to its own places
  ros::param::getCached("trial_node/job", job);
  return status_.trial_waits() && !led && job.empty() ? goal_ : std::nullopt;
}

status::Shown Reader::shown() {
  read_words();
  return banner_.hold(status_.shown(now(), ros::Time::now().toSec()), now());
}

}  // namespace navvi_rviz::plugin
