#pragma once

#include <ros/console.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

namespace navvi_types {

/// Subscribes to `topic` without delay: `convert` turns each message into the value for `take`. A
/// message that it rejects, or that is not in `frame` (empty: in any), is dropped whole, counted,
/// and logged at most every 5 s (safety rule 2). \param rejected  is called for each such message
template <typename Message, typename Value, typename Take>
[[nodiscard]] ros::Subscriber subscribe(ros::NodeHandle& node, const std::string& topic,
                                        std::uint32_t queue,
                                        std::optional<Value> (*convert)(const Message&), Take take,
                                        const std::string& frame = {},
                                        const std::function<void()>& rejected = {}) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
      [topic, convert, take, frame, rejected,
       dropped = 0U](const boost::shared_ptr<const Message>& msg) mutable {
        const std::string* const in = ros::message_traits::frameId(*msg);
        const std::optional<Value> value = convert(*msg);
        if (value && (frame.empty() || (in && *in == frame))) return take(*value);
        ++dropped;
        if (rejected) rejected();
        ROS_WARN_THROTTLE(
            5.0, "A message on %s is malformed or in another frame and was dropped (%u so far).",
            topic.c_str(), dropped);
      };
  return node.subscribe<Message>(topic, queue, callback, ros::VoidConstPtr(),
                                 ros::TransportHints().tcpNoDelay());
}

}  // namespace navvi_types
