#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/Scenario.h>
#include <navvi_msgs/StateHash.h>
#include <navvi_msgs/TrialEvent.h>
#include <sensor_msgs/Joy.h>
#include <tf2_msgs/TFMessage.h>

#include <optional>

#include "navvi_study/odometry_in_map.hpp"
#include "navvi_study/simulated_operator.hpp"
#include "navvi_study/trial_monitor.hpp"

namespace navvi_study {

// nullopt stands for a message with a number that is not finite, or a word that means nothing: it
// is dropped whole.
[[nodiscard]] std::optional<OdometryReport> from_msg(const nav_msgs::Odometry& msg);
[[nodiscard]] std::optional<ContactReport> from_msg(const navvi_msgs::Contact& msg);
[[nodiscard]] std::optional<ProximityReport> from_msg(const navvi_msgs::Proximity& msg);
[[nodiscard]] std::optional<GuidanceReport> from_msg(const navvi_msgs::Guidance& msg);
[[nodiscard]] std::optional<CueReport> from_msg(const navvi_msgs::Cue& msg);
[[nodiscard]] std::optional<DriveReport> from_msg(const navvi_msgs::DriveState& msg);
[[nodiscard]] std::optional<StateReport> from_msg(const navvi_msgs::StateHash& msg);
[[nodiscard]] std::optional<ScenarioReport> from_msg(const navvi_msgs::Scenario& msg);
/// Only the devices of feedback_node.
[[nodiscard]] std::vector<DeviceReport> from_msg(const diagnostic_msgs::DiagnosticArray& msg);
/// Only map -> odom. \param for_good  the message is one of /tf_static
[[nodiscard]] std::vector<Correction> from_msg(const tf2_msgs::TFMessage& msg, bool for_good);
[[nodiscard]] std::optional<Point2> from_msg(const geometry_msgs::PoseStamped& msg);

[[nodiscard]] geometry_msgs::PoseStamped goal_msg(const Point2& goal, const ros::Time& stamp);
[[nodiscard]] navvi_msgs::TrialEvent to_msg(const Row& row);
/// nullopt if its fields are not in order. mono_ns is not in the message and stays 0.
[[nodiscard]] std::optional<Row> from_msg(const navvi_msgs::TrialEvent& msg);

/// What of a cue an operator can hear; nullopt for what cannot be heard.
[[nodiscard]] std::optional<HeardSpeech> heard(const navvi_msgs::Cue& msg);
[[nodiscard]] sensor_msgs::Joy to_msg(const StickAndButtons& hand, const ros::Time& stamp);

}  // namespace navvi_study
