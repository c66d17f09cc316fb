#include "navvi_safety/now.hpp"

#include <ros/time.h>

namespace navvi_safety {

Instant now() { return {ros::SteadyTime::now().toSec(), ros::Time::now().toSec()}; }

}  // namespace navvi_safety
