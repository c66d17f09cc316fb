#pragma once

#include <geometry_msgs/Transform.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/Proximity.h>
#include <sensor_msgs/Joy.h>
#include <sensor_msgs/JoyFeedbackArray.h>

#include <optional>
#include <vector>

#include "navvi_feedback/cue.hpp"
#include "navvi_feedback/haptics.hpp"
#include "navvi_feedback/input_state.hpp"
#include "navvi_feedback/situation.hpp"

namespace navvi_feedback {

// What comes in. nullopt for a message that holds a number that is not finite, or out of the range
// its definition gives: it is dropped whole (safety rule 2).

/// A class that is unknown here counts as other: it is felt all the same.
[[nodiscard]] std::optional<std::vector<Nearby>> from_msg(const navvi_msgs::Proximity& msg);
/// The point of contact as seen from the robot at that instant.
[[nodiscard]] std::optional<Situation::Contact> from_msg(const navvi_msgs::Contact& msg);
[[nodiscard]] std::optional<Guidance> from_msg(const navvi_msgs::Guidance& msg);
[[nodiscard]] std::optional<Situation::Gate> from_msg(const navvi_msgs::DriveState& msg);
[[nodiscard]] std::optional<Situation::Motion> from_msg(const nav_msgs::Odometry& msg);
/// The path's points in its frame, m.
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> from_msg(const nav_msgs::Path& msg);
/// Axes out of [-1, 1] by more than rounding, or fewer than two, are refused.
[[nodiscard]] std::optional<InputState> from_msg(const sensor_msgs::Joy& msg);

/// rad in (-pi, pi], clockwise from the robot's nose to `target`.
/// \param robot   base_link in the frame of `target`
/// \param target  m
/// \return nullopt if the transform is not finite or its quaternion not of unit length
[[nodiscard]] std::optional<double> angle_to(const geometry_msgs::Transform& robot,
                                             const Eigen::Vector2d& target);

// What goes out.

[[nodiscard]] sensor_msgs::Joy to_msg(const InputState& input, const ros::Time& stamp);
/// As joy_node takes it: id 0 is the strong (left) motor, id 1 the weak (right) one.
[[nodiscard]] sensor_msgs::JoyFeedbackArray feedback_msg(const Rumble& rumble);
[[nodiscard]] navvi_msgs::Cue to_msg(const CueEvent& event, const ros::Time& stamp);
/// \param id  counts the changes of the motors
[[nodiscard]] navvi_msgs::Cue rumble_msg(const Rumble& rumble, std::uint32_t id,
                                         const ros::Time& stamp);

}  // namespace navvi_feedback
