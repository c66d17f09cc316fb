#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::cues {

class Phrases;  // the words of a language

struct VoiceOrder {
  bool stop = false;                      ///< fall silent, before `start`
  std::optional<std::string> start = {};  ///< begin to speak this text
  bool asked = false;                     ///< it answers a button
  std::vector<sounds::Play> scan = {};    ///< one before each part of the text
};

}  // namespace navvi_feedback::cues
