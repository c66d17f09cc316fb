#pragma once

#include <ros/console.h>
#include <ros/message_traits.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "navvi_types/checked.hpp"

namespace navvi_types {

/// Counts sentences by kind, so that a log tells each kind once: those that differ in their numbers
/// alone are of one kind.
class Once {
 public:
  struct Kind {
    std::string first;   ///< the sentence as it came first
    unsigned count = 0;  ///< so far
  };

  /// True if the sentence is the first of its kind. Beyond 100 kinds none is new.
  bool operator()(const std::string& sentence) {
    std::string key;
    std::copy_if(sentence.begin(), sentence.end(), std::back_inserter(key), [](unsigned char c) {
      return std::isdigit(c) == 0 && c != '.' && c != '-';
    });
    if (const auto known = kinds_.find(key); known != kinds_.end())
      return ++known->second.count, false;
    return kinds_.size() < kMost && kinds_.emplace(std::move(key), Kind{sentence, 1U}).second;
  }
  [[nodiscard]] const std::map<std::string, Kind>& kinds() const { return kinds_; }

 private:
  static constexpr std::size_t kMost = 100;
  std::map<std::string, Kind> kinds_;
};

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
