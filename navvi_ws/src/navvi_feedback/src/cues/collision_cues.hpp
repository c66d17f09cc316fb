#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

#include "cues/phrases.hpp"
#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {

/// Tells what was hit, and where: each thing, but one that is touched again and again only once in
/// a while.
class CollisionCues {
 public:
  /// \param contacts  begun since the last update \param time  s, monotonic
  [[nodiscard]] Utterances update(const std::vector<Contact>& contacts, double time) {
    constexpr double kSameHit = 1.5;  // s; the same thing again within it is the same collision.
    for (auto hit = hit_.begin(); hit != hit_.end();)
      hit = time - hit->second >= kSameHit ? hit_.erase(hit) : std::next(hit);
    Utterances told;
    for (const Contact& contact : contacts) {
      if (!hit_.emplace(contact.id, time).second) continue;
      const ThingClass thing = contact.thing_class;
      told.push_back({{CueKind::collision, about(thing)},
                      {{}, {}, thing, side_of(contact.seen_from_robot())}});
    }
    return told;
  }

 private:
  std::map<std::uint32_t, double> hit_;  ///< s, by thing
};

}  // namespace navvi_feedback::cues
