#pragma once

namespace navvi_types {

/// m above the floor, of a robot with its load: what begins higher does not matter to it. The map,
/// the simulated hull, what is near and what a robot's own sensors see share this default.
inline constexpr double kHeadroom = 0.8;

}  // namespace navvi_types
