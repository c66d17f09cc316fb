#pragma once

#include <optional>
#include <vector>

#include "types.hpp"

namespace navvi_feedback::cues {

/// Keeps out of the record what nobody can have heard.
class HeardWords {
 public:
  /// \param heard  what is played now reaches somebody
  /// \return the events; words that start unheard are dropped instead, and say no more
  [[nodiscard]] std::vector<CueEvent> of(std::vector<CueEvent> events, bool heard);

 private:
  std::optional<std::uint32_t> unheard_;  ///< the words that are timed without a device
};

}  // namespace navvi_feedback::cues
