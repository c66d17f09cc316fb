#pragma once

#include <optional>

namespace navvi_feedback::cues {

/// Whether a stream of messages, or a device, lives.
enum class Link { never, alive, lost };

/// \param last     s, when the last message came; nullopt if none ever did
/// \param now      s, on the same clock
/// \param timeout  s, the age at which a stream counts as lost
[[nodiscard]] inline Link link_state(std::optional<double> last, double now, double timeout) {
  if (!last) return Link::never;
  return now - *last <= timeout ? Link::alive : Link::lost;
}

}  // namespace navvi_feedback::cues
