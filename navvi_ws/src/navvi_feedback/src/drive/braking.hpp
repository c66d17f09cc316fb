#pragma once

#include <vector>

#include "types.hpp"

namespace navvi_feedback::drive {

/// m, ahead or back: of a robot that brakes now. \param speed  m/s
[[nodiscard]] double stopping_distance(double speed);

/// m/s, at which the robot stops before what it drives towards: the round trip and a
/// person's reaction pass before the wheels brake. No limit without a delay.
/// \param round_trip  s \param wanted  forward or back \param nearby  in base_link
[[nodiscard]] double fastest(double round_trip, const Velocity& wanted,
                             const std::vector<NearThing>& nearby);

}  // namespace navvi_feedback::drive
