#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <navvi_msgs/TrialEvent.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/TimeReference.h>
#include <tf2_msgs/TFMessage.h>

#include <navvi_types/msg_conversion.hpp>
#include <optional>
#include <vector>

#include "trial/odometry_in_map.hpp"
#include "trial/tracker.hpp"
#include "trial/trial_monitor.hpp"

namespace navvi_study::node {

using navvi_types::from_msg;
using navvi_types::to_msg;

/// Only the devices of feedback_node.
[[nodiscard]] std::vector<trial::DeviceReport> from_msg(
    const diagnostic_msgs::DiagnosticArray& msg);
/// Only the place of odom in its parent, which is map; one that is not finite or out of range is
/// left out.
/// \param for_good  the message is one of /tf_static
[[nodiscard]] std::vector<trial::Correction> from_msg(const tf2_msgs::TFMessage& msg, bool for_good,
                                                      const std::string& odom_frame);
/// nullopt if the clock's name is not 1 to 16 lower-case letters.
/// \param msg  its stamp is the monotonic clock of this computer, as the journal's mono_ns
[[nodiscard]] std::optional<trial::ClockOffset> from_msg(const sensor_msgs::TimeReference& msg);

/// nullopt if it lacks the stick. Axes and buttons are those of feedback_node.
[[nodiscard]] std::optional<trial::Hands> from_msg(const sensor_msgs::Joy& msg);

[[nodiscard]] navvi_msgs::TrialEvent to_msg(const record::Row& row);
/// nullopt if its fields are not in order. mono_ns is not in the message and stays 0.
[[nodiscard]] std::optional<record::Row> from_msg(const navvi_msgs::TrialEvent& msg);

}  // namespace navvi_study::node
