#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cues/phrases.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::menu {

/// A parameter of feedback_node that a person can change while driving.
struct Setting {
  cues::SettingName name = cues::SettingName::rate;
  const char* key = "";  ///< such as speaker/rate
  /// Its values, each a step louder, stronger, faster or more than the one before.
  std::vector<std::string> values;
  /// An example of it, besides the words that tell its value.
  bool felt = false;
  std::optional<sounds::Earcon> heard = {};

  /// \param value  as the parameter has it, also between two of `values`
  /// \return the next of `values`, up or down; at the end the last
  [[nodiscard]] std::string step(const std::string& value, bool up) const;
  /// How it is said. \param value  as the parameter has it
  [[nodiscard]] cues::Utterance say(About entry, const std::string& value) const;
};

/// All that can be changed, in the order of the menu. No safety phrase and no pattern of the motors
/// can be muted by it.
[[nodiscard]] const std::vector<Setting>& settings();

}  // namespace navvi_feedback::menu
