#pragma once

#include <navvi_types/thing.hpp>

namespace navvi_feedback::cues {

/// What stands for good: a shelf or a wall.
[[nodiscard]] constexpr bool is_structure(navvi_types::ThingClass thing) {
  return thing == navvi_types::ThingClass::shelf || thing == navvi_types::ThingClass::wall;
}

}  // namespace navvi_feedback::cues
