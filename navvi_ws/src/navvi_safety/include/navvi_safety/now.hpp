#pragma once

#include "navvi_safety/command_gate.hpp"

namespace navvi_safety {

/// The present instant: monotonic wall clock and ROS time.
[[nodiscard]] Instant now();

}  // namespace navvi_safety
