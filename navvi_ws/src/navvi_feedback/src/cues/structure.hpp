#pragma once

#include <navvi_types/cue_kind.hpp>
#include <navvi_types/thing.hpp>

namespace navvi_feedback::cues {

/// What stands for good: a shelf or a wall.
[[nodiscard]] constexpr bool is_structure(navvi_types::ThingClass thing) {
  return thing == navvi_types::ThingClass::shelf || thing == navvi_types::ThingClass::wall;
}
/// As words tell it: a shelf, a wall, or an obstacle.
[[nodiscard]] constexpr navvi_types::About about(navvi_types::ThingClass thing) {
  if (!is_structure(thing)) return navvi_types::About::obstacle;
  return thing == navvi_types::ThingClass::wall ? navvi_types::About::wall
                                                : navvi_types::About::shelf;
}

}  // namespace navvi_feedback::cues
