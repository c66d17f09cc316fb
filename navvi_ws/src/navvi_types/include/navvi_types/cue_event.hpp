#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "navvi_types/names.hpp"

namespace navvi_types {

enum class CueStage : std::uint8_t { queued, started, ended, cut, dropped };
[[nodiscard]] constexpr std::array<const char*, 5> names(CueStage) {
  return {"queued", "started", "ended", "cut", "dropped"};
}

enum class Modality : std::uint8_t { speech, rumble, sound };
[[nodiscard]] constexpr std::array<const char*, 3> names(Modality) {
  return {"speech", "rumble", "sound"};
}

/// The scale of speech-dispatcher, least first.
enum class Priority : std::uint8_t { progress, notification, text, message, important };
[[nodiscard]] constexpr std::array<const char*, 5> names(Priority) {
  return {"progress", "notification", "text", "message", "important"};
}

/// One moment in the life of a message that is spoken, felt, or a short sound.
struct CueEvent {
  std::uint32_t id = 0;  ///< the same through the cue's life, 1 for the first, no gaps
  CueStage stage = CueStage::queued;
  std::string kind = {};  ///< the phrase's key, such as turn_now, or the pattern's or sound's name
  std::string text = {};  ///< as spoken; else empty
  Priority priority = Priority::text;
  Modality modality = Modality::speech;
  double left = 0.0;  ///< motor command, or share of a sound from the left, [0, 1]; 0 for speech
  double right = 0.0;
  std::int64_t stamp = 0;  ///< ns, ROS time
};

}  // namespace navvi_types
