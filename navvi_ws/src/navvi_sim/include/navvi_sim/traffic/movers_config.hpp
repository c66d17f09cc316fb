#pragma once

namespace navvi_sim::traffic {

/// How things with a route behave (R-SIM-3).
struct MoversConfig {
  /// movers stop for the robot unless their route says otherwise; false: none does
  bool yield = true;
  double acceleration = 0.8;  ///< m/s^2, of movers, to faster and to slower, and sideways in curves
  double turn_rate = 1.0;     ///< rad/s, of movers, on the spot and in curves
  double clearance = 0.4;     ///< m, gap at which movers stop before the robot
  double patience = 8.0;  ///< s, after which a mover that the robot blocks reverses, to let it pass
  double back_speed = 0.5;  ///< m/s, at most, of a mover in reverse
  /// share by which pauses at way-points vary either way, drawn from the seed
  double pause_spread = 0.3;
};

}  // namespace navvi_sim::traffic
