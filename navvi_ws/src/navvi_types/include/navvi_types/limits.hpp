#pragma once

#include <cstddef>

/// What a message may hold: one limit a quantity, for every package. A value beyond its limit is
/// garbage, and the message is dropped whole (safety rule 2). Signs and the narrower ranges of
/// single fields (angles, motor commands) stand in the definitions of the messages.
namespace navvi_types {

/// m, of each coordinate of a place. Recast and the pad's markers compute in single precision,
/// which resolves 8 mm at this distance; a robot's map is some km wide at most.
inline constexpr double kFarthest = 1e5;
/// m, of a distance, or of a path. No path within kFarthest that a robot can drive is longer.
inline constexpr double kLongest = 1e6;
/// m/s and rad/s. Ten times what the fastest vehicle indoors does, and above the most that
/// CommandGate lets pass by default.
inline constexpr double kFastest = 100.0;
/// m, of the radius and the height of a moving thing: a reach stacker has 12.
inline constexpr double kLargest = 20.0;
/// m, by which the rectangle of a moving thing may stick out of its cylinder.
inline constexpr double kSticksOut = 1e-3;
/// s, of an age or a duration: 30 years, so a clock that begins in 1970 never gets there by chance.
inline constexpr double kLongestTime = 1e9;
/// By how much the square of a quaternion's norm may differ from 1. As in tf2's own check of
/// transforms (buffer_core.cpp, QUATERNION_NORMALIZATION_TOLERANCE), which poses pass anyway.
inline constexpr double kUnitSlack = 1e-2;
/// By how much a rounded value may lie beyond the end of a closed range: angles, motor commands.
inline constexpr double kRounding = 1e-6;
/// Things in one message.
inline constexpr std::size_t kMostThings = 10000;
/// Points of one path.
inline constexpr std::size_t kMostPoints = 100000;

}  // namespace navvi_types
