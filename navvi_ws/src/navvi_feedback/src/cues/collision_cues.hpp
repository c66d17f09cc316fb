#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "cues/phrases.hpp"
#include "senses/observation.hpp"

namespace navvi_feedback::cues {

/// Tells what was hit, and where: each thing, but one that is touched again and again only once in
/// a while.
class CollisionCues {
 public:
  /// \param contacts  begun since the last update \param time  s, monotonic
  [[nodiscard]] Utterances update(const std::vector<Contact>& contacts, double time);

 private:
  std::map<std::uint32_t, double> hit_;  ///< s, by thing
};

}  // namespace navvi_feedback::cues
