#pragma once

#include "lead/course.hpp"
#include "navvi_feedback/haptics/rumble.hpp"

namespace navvi_feedback::lead {

/// A course as one sound between the ears: its place is the angle to steer, its pitch the speed.
/// Silence is to stand, so that a dead voice leads nobody on.
/// \return shares of the left and the right ear; their sum is the speed, from kSlowest to 1
[[nodiscard]] haptics::Rumble flow_of(const Course& course);

/// Of the sum, where the robot is to turn on the spot.
constexpr double kSlowest = 0.1;
/// rad, that sounds in one ear alone.
constexpr double kFullTurn = 0.7;

}  // namespace navvi_feedback::lead
