#pragma once

#include <yaml-cpp/yaml.h>

#include <regex>
#include <string>
#include <vector>

#include "devices/voice.hpp"

// For tests: what the voice may have to say.

namespace navvi_feedback::devices {

using Texts = std::vector<std::string>;

/// A place of a phrase that is filled.
inline const std::regex kGap("\\{\\w+\\}");

inline Texts texts_in(const YAML::Node& node) {
  if (node.IsScalar()) return {node.as<std::string>()};
  Texts all;
  for (const auto& entry : node)
    for (const std::string& text : texts_in(node.IsMap() ? entry.second : entry))
      all.push_back(text);
  return all;
}

inline YAML::Node phrases(const std::string& language) {
  return YAML::LoadFile(NAVVI_FEEDBACK_CONFIG_DIR "/phrases/" + language + ".yaml");
}

/// How many of them a voice does not speak, or is lost over.
inline unsigned unsaid(Voice& voice, const Texts& texts) {
  unsigned count = 0;
  for (const std::string& text : texts) {
    const auto sound = voice.begin(text, 440);
    if (!sound || (sound->samples.empty() && !text.empty()) || !voice.rest()) ++count;
  }
  return count;
}

}  // namespace navvi_feedback::devices
