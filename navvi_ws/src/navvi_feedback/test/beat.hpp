#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/guide_parts.hpp"

namespace navvi_feedback::core {

inline const std::string kEnglish = std::string(NAVVI_FEEDBACK_CONFIG_DIR) + "/phrases/en.yaml";

/// For tests: what a guide puts out in a beat, and what it has decided on the way there.
struct Beat : Output {
  std::vector<cues::Cue> cues;
  std::vector<CueEvent> events;  ///< of the queue of words, heard or not
  std::optional<haptics::Pattern> pattern;
};

/// \return nothing while the guide catches up
[[nodiscard]] inline Beat beat(Guide& guide, const Devices& devices, double time) {
  const std::optional<Output> out = guide.update(devices, time);
  if (!out) return {};
  return {*out, guide.parts().decided, guide.parts().words, guide.parts().touch.playing()};
}

}  // namespace navvi_feedback::core
