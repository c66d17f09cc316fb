#pragma once

#include <sensor_msgs/Joy.h>

#include <navvi_types/msg_conversion.hpp>

#include "navvi_people/people/simulated_operator.hpp"

namespace navvi_people::node {

using navvi_types::from_msg;
using navvi_types::to_msg;

[[nodiscard]] sensor_msgs::Joy to_msg(const people::StickAndButtons& hand, const ros::Time& stamp);

}  // namespace navvi_people::node
