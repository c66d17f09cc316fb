#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <navvi_msgs/Contact.h>
#include <navvi_msgs/Cue.h>
#include <navvi_msgs/DriveState.h>
#include <navvi_msgs/Guidance.h>
#include <navvi_msgs/LinkState.h>
#include <navvi_msgs/Obstacles.h>
#include <navvi_msgs/Proximity.h>
#include <navvi_msgs/Scenario.h>
#include <navvi_msgs/StateHash.h>
#include <navvi_msgs/TrialRequest.h>
#include <navvi_msgs/TrialState.h>
#include <navvi_msgs/Zone.h>

#include <optional>
#include <vector>

#include "navvi_types/checked.hpp"
#include "navvi_types/cue_event.hpp"
#include "navvi_types/drive_state.hpp"
#include "navvi_types/guidance.hpp"
#include "navvi_types/link_state.hpp"
#include "navvi_types/scenario.hpp"
#include "navvi_types/trial.hpp"
#include "navvi_types/zone.hpp"

namespace navvi_types {

// Incoming messages. nullopt for a message with a number that is not finite, beyond limits.hpp or
// out of the range in its definition, or with an unknown constant: it is dropped whole (safety
// rule 2). Frames are not checked. An unknown class of things counts as other.

[[nodiscard]] std::optional<Velocity> from_msg(const geometry_msgs::Twist& msg);
[[nodiscard]] std::optional<Pose2> from_msg(const geometry_msgs::Transform& msg);
/// A goal is a place: its direction must be finite, but need not be a rotation. m
[[nodiscard]] std::optional<Eigen::Vector2d> from_msg(const geometry_msgs::PoseStamped& msg);
/// m
[[nodiscard]] std::optional<Eigen::Vector2d> from_msg(const geometry_msgs::PointStamped& msg);
[[nodiscard]] Checked<Odometry> from_msg(const nav_msgs::Odometry& msg);
/// The lower corner of cell (0, 0) in the map's frame, and how the grid is turned about it. Mappers
/// leave the quaternion of a grid that is not turned at 0 0 0 0, which counts as 0 0 0 1.
[[nodiscard]] Checked<Pose2> origin_of(const nav_msgs::OccupancyGrid& msg);
/// The path's points in its frame, m.
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> from_msg(const nav_msgs::Path& msg);
[[nodiscard]] std::optional<Proximity> from_msg(const navvi_msgs::Proximity& msg);
[[nodiscard]] std::optional<Contact> from_msg(const navvi_msgs::Contact& msg);
/// nullopt also if an id repeats.
[[nodiscard]] std::optional<Obstacles> from_msg(const navvi_msgs::Obstacles& msg);
[[nodiscard]] std::optional<Guidance> from_msg(const navvi_msgs::Guidance& msg);
[[nodiscard]] std::optional<CueEvent> from_msg(const navvi_msgs::Cue& msg);
[[nodiscard]] std::optional<DriveState> from_msg(const navvi_msgs::DriveState& msg);
[[nodiscard]] std::optional<LinkState> from_msg(const navvi_msgs::LinkState& msg);
[[nodiscard]] std::optional<ZoneState> from_msg(const navvi_msgs::Zone& msg);
[[nodiscard]] std::optional<Scenario> from_msg(const navvi_msgs::Scenario& msg);
/// nullopt if its hash is not 16 hexadecimal digits in lower case.
[[nodiscard]] std::optional<StateHash> from_msg(const navvi_msgs::StateHash& msg);
[[nodiscard]] std::optional<TrialState> from_msg(const navvi_msgs::TrialState& msg);
[[nodiscard]] std::optional<TrialRequest> from_msg(const navvi_msgs::TrialRequest& msg);

// Outgoing messages, in the frame that the message's definition names.

[[nodiscard]] geometry_msgs::Twist to_msg(const Velocity& velocity);
/// odom -> base_link
[[nodiscard]] nav_msgs::Odometry to_msg(const Odometry& odometry);
[[nodiscard]] navvi_msgs::Proximity to_msg(const Proximity& proximity);
[[nodiscard]] navvi_msgs::Contact to_msg(const Contact& contact);
[[nodiscard]] navvi_msgs::Obstacles to_msg(const Obstacles& obstacles);
[[nodiscard]] navvi_msgs::Guidance to_msg(const Guidance& guidance);
[[nodiscard]] navvi_msgs::Cue to_msg(const CueEvent& event);
[[nodiscard]] navvi_msgs::DriveState to_msg(const DriveState& state);
[[nodiscard]] navvi_msgs::LinkState to_msg(const LinkState& state);
[[nodiscard]] navvi_msgs::Zone to_msg(const ZoneState& state);
[[nodiscard]] navvi_msgs::Scenario to_msg(const Scenario& scenario);
[[nodiscard]] navvi_msgs::StateHash to_msg(const StateHash& state);
[[nodiscard]] navvi_msgs::TrialState to_msg(const TrialState& state);
[[nodiscard]] navvi_msgs::TrialRequest to_msg(const TrialRequest& request);

/// Places in the message's frame. \param z  m
[[nodiscard]] geometry_msgs::Point point_msg(const Eigen::Vector2d& point, double z);
[[nodiscard]] inline geometry_msgs::Point point_msg(const Eigen::Vector3d& point) {
  return point_msg(point.head<2>(), point.z());
}
[[nodiscard]] geometry_msgs::Pose pose_msg(const Pose2& pose, double z);
/// A path whose poses look along it; the last one as the one before it. \param floor  m, z
[[nodiscard]] nav_msgs::Path path_msg(const std::vector<Eigen::Vector2d>& points, double floor,
                                      std::int64_t stamp, const std::string& frame = "map");
/// A goal in map.
[[nodiscard]] geometry_msgs::PoseStamped goal_msg(const Eigen::Vector2d& goal, std::int64_t stamp);

/// ns since the epoch of ROS time, and back; a time before it counts as it.
[[nodiscard]] std::int64_t to_ns(const ros::Time& time);
[[nodiscard]] ros::Time from_ns(std::int64_t ns);

}  // namespace navvi_types
