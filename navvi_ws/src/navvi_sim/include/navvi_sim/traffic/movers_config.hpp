#pragma once

#include <navvi_config/field.hpp>

namespace navvi_sim::traffic {

/// How things with a route behave (R-SIM-3).
struct MoversConfig {
  bool yield = true;          ///< stop for the robot ahead, where the route says so too
  double acceleration = 0.8;  ///< m/s^2, to faster and to slower, and sideways in curves
  double turn_rate = 1.0;     ///< rad/s
  double clearance = 0.4;     ///< m, at which they stop before the robot
  double patience = 8.0;      ///< s, after which a mover that the robot blocks reverses
  double back_speed = 0.5;    ///< m/s, at most, in reverse
  double pause_spread = 0.3;  ///< share by which a pause varies either way, drawn from the seed

  void describe(navvi_config::Visitor& visit);
};

}  // namespace navvi_sim::traffic
