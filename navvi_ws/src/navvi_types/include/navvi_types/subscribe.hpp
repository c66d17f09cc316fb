#pragma once

#include <ros/console.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "navvi_types/checked.hpp"
#include "navvi_types/once.hpp"

namespace navvi_types {

/// A frame's name as tf2 has it; ROS 1's first drivers begin it with a slash.
[[nodiscard]] inline std::string without_slash(const std::string& frame) {
  return frame.substr(!frame.empty() && frame.front() == '/' ? 1 : 0);
}

/// Subscribes to `topic` without delay: `convert` turns each message into the value for `take`. A
/// message that it rejects, or that is not in `frame` (empty: in any), is dropped whole, and each
/// kind of reason is logged once (safety rule 2). \param convert  to std::optional or Checked
/// \param rejected  is called with the reason for each such message
template <typename Message, typename Result, typename Take>
[[nodiscard]] ros::Subscriber subscribe(
    ros::NodeHandle& node, const std::string& topic, std::uint32_t queue,
    Result (*convert)(const Message&), Take take, const std::string& frame = {},
    const std::function<void(const std::string&)>& rejected = {}) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
      [topic, convert, take, frame, rejected,
       once = Once()](const boost::shared_ptr<const Message>& msg) mutable {
        const std::string* const in = ros::message_traits::frameId(*msg);
        const Result value = convert(*msg);
        const bool here = frame.empty() || (in && without_slash(*in) == frame);
        if (value && here) return take(*value);
        const std::string why =
            value ? "it is in frame '" + (in ? *in : "") + "', not '" + frame + "'"
                  : why_not(value);
        if (once(why))
          ROS_WARN("A message on %s was dropped: %s. More of this kind are dropped unsaid.",
                   topic.c_str(), why.c_str());
        if (rejected) rejected(why);
      };
  return node.subscribe<Message>(topic, queue, callback, ros::VoidConstPtr(),
                                 ros::TransportHints().tcpNoDelay());
}

}  // namespace navvi_types
