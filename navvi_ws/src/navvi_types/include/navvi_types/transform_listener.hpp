#pragma once

#include <ros/console.h>
#include <ros/node_handle.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "navvi_types/subscribe.hpp"

namespace navvi_types {

/// The newest transform from `child` to `parent`; nullopt where there is none, or where it is
/// stamped more than 0.3 s ahead of `now`. Such a one empties the buffer: it would stay the newest,
/// and look fresh as soon as its time has come.
[[nodiscard]] inline std::optional<geometry_msgs::TransformStamped> newest(
    tf2::BufferCore& buffer, const std::string& parent, const std::string& child,
    const ros::Time& now) {
  constexpr double kMostAhead = 0.3;  // s
  try {
    const geometry_msgs::TransformStamped found =
        buffer.lookupTransform(parent, child, ros::Time(0));
    if ((found.header.stamp - now).toSec() <= kMostAhead) return found;
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
  ROS_WARN_THROTTLE(5.0, "The transform from %s to %s is stamped ahead of this clock and dropped.",
                    parent.c_str(), child.c_str());
  buffer.clear();
  return std::nullopt;
}

/// The place of odometry's frame in the map holds until the localizer corrects it, which some do
/// each five seconds: for twice the time between the last two corrections, 1 to 10 s.
class HeldPlace {
 public:
  explicit HeldPlace(std::string odom_frame) : odom_frame_(std::move(odom_frame)) {}

  /// Takes each moving transform. \return the place as of the stamp of one that odometry sent
  [[nodiscard]] std::optional<geometry_msgs::TransformStamped> at_the_stamp_of(
      const geometry_msgs::TransformStamped& one) {
    const double since = place_ ? (one.header.stamp - place_->header.stamp).toSec() : kLongest;
    if (without_slash(one.child_frame_id) == odom_frame_ && since > 0.0) {
      hold_ = std::clamp(2.0 * since, 1.0, kLongest);
      place_ = one;
    } else if (place_ && without_slash(one.header.frame_id) == odom_frame_ && since > 0.0 &&
               since <= hold_) {
      geometry_msgs::TransformStamped held = *place_;
      held.header.stamp = one.header.stamp;
      return held;
    }
    return std::nullopt;
  }
  [[nodiscard]] const std::string& odom_frame() const { return odom_frame_; }

 private:
  static constexpr double kLongest = 10.0;  // s

  std::string odom_frame_;
  std::optional<geometry_msgs::TransformStamped> place_;
  double hold_ = kLongest;  ///< s
};

/// Fills a buffer from /tf and /tf_static, as tf2_ros::TransformListener does, and besides rejects
/// transforms stamped more than 2 s ahead of ROS time: tf2 drops all that are 10 s older than the
/// latest, so that a single one keeps out all that follow. Localizers stamp map -> odom up to 1 s
/// ahead. A jump back of ROS time empties the buffer. Lives in the thread of the global queue.
class TransformListener {
 public:
  TransformListener(tf2_ros::Buffer& buffer, const std::string& odom_frame)
      : buffer_(buffer), place_(odom_frame) {
    const auto listen = [this](const char* topic, bool fixed) {
      const boost::function<void(const Event&)> take = [this, fixed](const Event& event) {
        receive(event, fixed);
      };
      return node_.subscribe<tf2_msgs::TFMessage>(topic, kQueue, take, ros::VoidConstPtr(),
                                                  ros::TransportHints().tcpNoDelay());
    };
    moving_ = listen("/tf", false);
    fixed_ = listen("/tf_static", true);
  }
  TransformListener(const TransformListener&) = delete;
  TransformListener& operator=(const TransformListener&) = delete;

 private:
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;

  void receive(const Event& event, bool fixed) {
    const ros::Time now = ros::Time::now();
    if (now < last_) {
      buffer_.clear();
      place_ = HeldPlace(place_.odom_frame());
    }
    last_ = now;
    const std::string publisher = event.getPublisherName();
    std::vector<geometry_msgs::TransformStamped> transforms = event.getConstMessage()->transforms;
    // Or the place held would stand in the way of the one that comes with the same stamp.
    std::stable_partition(transforms.begin(), transforms.end(), [this](const auto& one) {
      return without_slash(one.child_frame_id) == place_.odom_frame();
    });
    for (const geometry_msgs::TransformStamped& one : transforms) {
      const double ahead = (one.header.stamp - now).toSec();
      if (!fixed && ahead > kMostAhead) {
        ROS_WARN_THROTTLE(5.0, "A transform from %s to %s by %s was dropped: it is %.1f s ahead.",
                          one.header.frame_id.c_str(), one.child_frame_id.c_str(),
                          publisher.c_str(), ahead);
        continue;
      }
      try {
        buffer_.setTransform(one, publisher, fixed);
        const auto held = fixed ? std::nullopt : place_.at_the_stamp_of(one);
        if (held) buffer_.setTransform(*held, publisher);
      } catch (const tf2::TransformException& error) {
        ROS_WARN_THROTTLE(5.0, "A transform by %s was dropped: %s", publisher.c_str(),
                          error.what());
      }
    }
  }

  static constexpr std::uint32_t kQueue = 100;
  static constexpr double kMostAhead = 2.0;  // s

  tf2_ros::Buffer& buffer_;
  ros::NodeHandle node_;
  HeldPlace place_;
  ros::Subscriber moving_, fixed_;
  ros::Time last_;
};

}  // namespace navvi_types
