#pragma once

#include <cstdint>
#include <string>

#include "navvi_types/limits.hpp"
#include "navvi_types/names.hpp"

namespace navvi_types {

/// The zone that holds the robot back, or in which it is, and what all zones allow it.
struct ZoneState {
  enum class Kind : std::uint8_t {
    none,
    keep_out,  ///< close by: the robot stops before it
    slow,      ///< the robot is in it
    rack,      ///< as keep_out
  };

  Kind kind = Kind::none;
  std::string name = {};       ///< as is_place_name() allows; empty: none
  double forward = kFastest;   ///< m/s, the most ahead
  double backward = kFastest;  ///< m/s, likewise back
  std::int64_t stamp = 0;      ///< ns, ROS time
};

}  // namespace navvi_types
