#pragma once

#include <ros/ros.h>

#include <functional>
#include <navvi_types/subscribe.hpp>
#include <navvi_types/transform_listener.hpp>
#include <optional>
#include <string>
#include <vector>

#include "devices/latencies.hpp"
#include "drive/stick_age.hpp"
#include "navvi_feedback/core/guide.hpp"
#include "node/node_config.hpp"
#include "node/person_devices.hpp"

namespace navvi_feedback::node {

/// s; wall time, so that the person hears of a simulation that has stopped.
inline double now() { return ros::SteadyTime::now().toSec(); }

/// The topics that feedback_node reads. What they bring goes to the guide, the stick or the next
/// beat; bad messages are dropped and counted.
class Inlets {
 public:
  /// A beat before its time. \param caused  the chain that a message begins which has just come
  using Beat = std::function<void(std::optional<devices::Chain> caused)>;

  /// \param guide, devices  outlive this
  Inlets(ros::NodeHandle& node, const NodeConfig& config, core::Guide& guide,
         PersonDevices& devices, Beat beat);

  /// Adds to the person's devices what topics say: the robot's place, and buttons by name.
  void complete(senses::Devices& devices);
  /// Those buttons were taken.
  void forget_buttons() { asked_.clear(); }
  /// m, in map
  [[nodiscard]] const std::vector<Eigen::Vector2d>& path() const { return path_; }
  /// Of the trial that waits to begin; m, in map
  [[nodiscard]] const std::vector<Eigen::Vector2d>& preview() const { return preview_; }

 private:
  template <typename Msg, typename Take>
  void listen(const std::string& topic, std::uint32_t queue, Take take);
  void subscribe_to_hands();
  void receive(drive::InputState joy, devices::InputSource& source);
  void subscribe_to_robot(const NodeConfig& config);
  void subscribe_to_trials();
  /// base_link in map; nullopt if it is stale or from the future
  [[nodiscard]] std::optional<navvi_types::Pose2> robot();

  ros::NodeHandle& node_;
  core::Guide& guide_;
  PersonDevices& devices_;
  Beat beat_;
  double stale_;  ///< s
  tf2_ros::Buffer tf_;
  navvi_types::TransformListener tf_listener_;
  std::vector<Eigen::Vector2d> path_, preview_;  ///< m, in map
  std::vector<drive::Button> asked_;             ///< by topic, not answered yet
  drive::StickAge stick_age_;
  drive::StickAge::Late logged_ = drive::StickAge::Late::no;
  bool twin_ = false;                            ///< another node drives under the name of this one
  bool runs_ = false;                            ///< a trial
  bool emergency_stop_ = false, battery_low_ = false;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace navvi_feedback::node
