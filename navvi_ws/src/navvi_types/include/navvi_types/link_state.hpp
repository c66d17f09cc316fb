#pragma once

#include <cstdint>

namespace navvi_types {

/// The connection between the person and the robot. Times are those of a round trip: the robot's
/// report to the person, and the command back.
struct LinkState {
  enum class Late : std::uint8_t {
    no,
    slow,      ///< the last command is more than 0.3 s later than usual
    too_late,  ///< more than 1 s
  };

  double round_trip = 0.0;     ///< s, median of the last 5 s
  double round_trip_99 = 0.0;  ///< s, their 99th percentile
  double jitter = 0.0;         ///< s, mean difference of two commands that follow each other
  double loss = 0.0;           ///< share of the commands that never came, [0, 1]
  double foresight = 0.0;      ///< s, by which guidance is ahead of the robot
  Late late = Late::no;
  std::int64_t stamp = 0;  ///< ns, ROS time
};

}  // namespace navvi_types
