#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace navvi_feedback {

/// The scale of speech-dispatcher, least first; the values of navvi_msgs/Cue.
enum class Priority : std::uint8_t { progress, notification, text, message, important };

/// One spoken message, before it is spoken.
struct Cue {
  std::string kind;  ///< the phrase's key, such as turn_now
  std::string text;  ///< as spoken
  Priority priority = Priority::text;
  double max_age = 2.0;  ///< s after which it is dropped if it has not begun
};

/// One moment of a cue's life; the values of navvi_msgs/Cue.
enum class CueStage : std::uint8_t { queued, started, ended, cut, dropped };

struct CueEvent {
  std::uint32_t id = 0;  ///< the same through the cue's life, 1 for the first, no gaps
  CueStage stage = CueStage::queued;
  Cue cue;
};

/// How a kind of cue is treated.
struct CueKind {
  const char* kind;
  Priority priority;
  double min_interval;  ///< s, the least time between two of the same kind
  double max_age;       ///< s, as Cue::max_age
};

/// Every kind there is. Each has a phrase.
[[nodiscard]] const std::vector<CueKind>& cue_kinds();
/// \throws std::logic_error for a kind that is none
[[nodiscard]] const CueKind& cue_kind(const std::string& kind);

}  // namespace navvi_feedback
