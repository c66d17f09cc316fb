#include "cues/collision_cues.hpp"

#include <iterator>

#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {

Utterances CollisionCues::update(const std::vector<Contact>& contacts, double time) {
  constexpr double kSameHit = 1.5;  // s; the same thing again within it is the same collision.
  for (auto hit = hit_.begin(); hit != hit_.end();)
    hit = time - hit->second >= kSameHit ? hit_.erase(hit) : std::next(hit);
  Utterances told;
  for (const Contact& contact : contacts) {
    if (!hit_.emplace(contact.id, time).second) continue;
    const ThingClass thing = contact.thing_class;
    told.push_back(
        {{CueKind::collision, about(thing)}, {{}, {}, thing, side_of(contact.seen_from_robot())}});
  }
  return told;
}

}  // namespace navvi_feedback::cues
