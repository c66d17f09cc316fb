#pragma once

#include <ros/time.h>

namespace navvi_feedback::node {

/// s; wall time, so that the person hears of a simulation that has stopped.
inline double now() { return ros::SteadyTime::now().toSec(); }

}  // namespace navvi_feedback::node
