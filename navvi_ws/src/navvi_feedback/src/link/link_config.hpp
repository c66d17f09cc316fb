#pragma once

#include <navvi_config/field.hpp>

namespace navvi_feedback::link {

/// A simulated connection between the person and the robot, each way by itself.
struct LinkConfig {
  double delay = 0.0;      ///< s, one way
  double jitter = 0.0;     ///< s, mean of what comes on top of the delay
  double loss = 0.0;       ///< share of the packets
  double outage = 0.0;     ///< s, once a minute
  double bandwidth = 0.0;  ///< kB/s; 0: any

  void describe(navvi_config::Visitor& visit);
  [[nodiscard]] bool simulated() const {
    return delay > 0.0 || jitter > 0.0 || loss > 0.0 || outage > 0.0 || bandwidth > 0.0;
  }
};

}  // namespace navvi_feedback::link
