#pragma once

#include <cstdint>
#include <string>

#include "navvi_types/names.hpp"

namespace navvi_types {

/// State of the last stage before the wheels.
struct DriveState {
  enum class State : std::uint8_t {
    waiting,  ///< no valid command yet
    running,
    stopped,  ///< wheels held at zero until the command was neutral for a while
  };
  enum class Reason : std::uint8_t {
    none,
    command_lost,
    command_invalid,
    driver_changed,  ///< commands came by another connection than before
    clock_jumped,    ///< ROS time jumped
    emergency_stop,  ///< the robot's is pressed
  };
  /// What is done to the person's command before what the robot would hit.
  enum class Assistance : std::uint8_t { nothing, slows, steers_left, steers_right };

  State state = State::waiting;
  Reason reason = Reason::none;
  std::uint32_t rejected = 0;  ///< bad commands so far
  std::int64_t stamp = 0;      ///< ns, ROS time
  /// The node that sent commands last though it may not drive, or beside another of its name.
  std::string intruder = {};
  Assistance assistance = Assistance::nothing;
};

}  // namespace navvi_types
