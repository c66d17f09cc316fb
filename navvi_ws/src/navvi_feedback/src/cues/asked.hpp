#pragma once

#include <optional>

#include "cues/phrases.hpp"

namespace navvi_feedback::cues {

/// What a person asks by a button.
enum class Question {
  way,     ///< the last direction again
  goal,    ///< where it is
  around,  ///< what is near, and on which side
  where,   ///< in which part of the world the robot is, and the goal from there
  turn,    ///< the next one
  help,    ///< what the buttons do
};

/// What the buttons of a tick come to, once a lesson and the menu took theirs.
struct Asked {
  std::optional<Utterance> menu;     ///< what the menu answers
  bool menu_closed = false;          ///< by itself
  std::optional<Question> question;  ///< whose button went down
};

}  // namespace navvi_feedback::cues
