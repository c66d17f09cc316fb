#pragma once

#include <navvi_types/names.hpp>

namespace navvi_feedback::drive {

/// What a person asks for by a button; up to turn these are questions about the way.
enum class Button {
  repeat,  ///< the last direction again
  goal,    ///< where it is
  around,  ///< what is near, and on which side
  where,   ///< aisle or room, and the goal from there
  turn,    ///< the next one
  help,    ///< what the buttons do
  start,   ///< begin the trial; in the menu, as choose
  end,     ///< end the trial, when pressed twice
  next,    ///< of the menu, as the three below
  previous,
  choose,
  back,
  settings,  ///< opens the menu there
  leave,     ///< closes the menu, and does nothing else
};
constexpr std::size_t kButtons = 14;

/// Of the first of them.
[[nodiscard]] constexpr bool is_question(Button button) { return button < Button::help; }

}  // namespace navvi_feedback::drive
