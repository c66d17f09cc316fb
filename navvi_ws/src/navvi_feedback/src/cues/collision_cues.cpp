#include "cues/collision_cues.hpp"

#include <iterator>

namespace navvi_feedback::cues {
namespace {

/// s; the same thing again within it is the same collision.
constexpr double kSameHit = 1.5;

CueKind kind_of(ThingClass thing) {
  if (thing == ThingClass::shelf) return CueKind::collision_shelf;
  return thing == ThingClass::wall ? CueKind::collision_wall : CueKind::collision_obstacle;
}

}  // namespace

Utterances CollisionCues::update(const std::vector<Contact>& contacts, double time) {
  for (auto hit = hit_.begin(); hit != hit_.end();)
    hit = time - hit->second >= kSameHit ? hit_.erase(hit) : std::next(hit);
  Utterances told;
  for (const Contact& contact : contacts) {
    if (!hit_.emplace(contact.id, time).second) continue;
    const Side side = side_of(contact.seen_from_robot());
    told.push_back({kind_of(contact.thing_class), {{}, {}, contact.thing_class, side}});
  }
  return told;
}

}  // namespace navvi_feedback::cues
