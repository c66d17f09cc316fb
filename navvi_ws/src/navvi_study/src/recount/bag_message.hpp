#pragma once

#include <rosbag/message_instance.h>

#include <stdexcept>

namespace navvi_study::recount {

/// The message as a `Message`; nullptr if it is of another type. \throws std::runtime_error with a
/// sentence if it is of that type as another version of NavVI knew it
template <typename Message>
[[nodiscard]] boost::shared_ptr<Message> message_of(const rosbag::MessageInstance& item) {
  boost::shared_ptr<Message> message = item.instantiate<Message>();
  if (!message && item.getDataType() == ros::message_traits::datatype<Message>())
    throw std::runtime_error("what is on " + item.getTopic() +
                             " was recorded by a NavVI with another " + item.getDataType());
  return message;
}

}  // namespace navvi_study::recount
