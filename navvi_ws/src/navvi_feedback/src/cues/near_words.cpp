#include "cues/near_words.hpp"

#include <algorithm>
#include <cmath>

#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {

/// m, gap; what is farther is not around.
constexpr double kAround = 3.0;

sounds::Earcon earcon_of(ThingClass thing) {
  const std::string name = to_string(is_structure(thing) ? ThingClass::shelf : thing);
  return navvi_types::from_word<sounds::Earcon>(name + "_near")
      .value_or(sounds::Earcon::thing_near);
}

std::optional<sounds::Play> instead_of(const Utterance& utterance, const Sounds& sounds) {
  using sounds::Earcon;
  if (!is_near(utterance.kind)) return std::nullopt;
  const bool close = utterance.kind == CueKind::close;
  const ThingClass thing = utterance.fillings.thing.value_or(ThingClass::other);
  const bool shelf = is_structure(thing);
  if (!(shelf ? sounds.shelf : sounds.near)) return std::nullopt;
  const Earcon near = earcon_of(thing);
  const auto earcon = close ? static_cast<Earcon>(static_cast<int>(near) + 1) : near;
  return sounds::Play{earcon, direction_of(utterance.fillings.side.value_or(Side::ahead))};
}

Utterance around(const std::vector<NearThing>& nearby) {
  const auto nearer = [](const NearThing* a, const NearThing* b) { return a->gap < b->gap; };
  std::vector<const NearThing*> nearest;  // clockwise
  for (const Side side : {Side::ahead, Side::right, Side::behind, Side::left}) {
    const NearThing* best = nullptr;
    for (const NearThing& thing : nearby)
      if (thing.gap < kAround && side_of(thing.nearest) == side && (!best || nearer(&thing, best)))
        best = &thing;
    if (best) nearest.push_back(best);
  }
  if (nearest.empty()) return {{CueKind::answer, About::around_nothing}};
  std::rotate(nearest.begin(), std::min_element(nearest.begin(), nearest.end(), nearer),
              nearest.end());
  std::vector<Utterance> told;
  for (const NearThing* thing : nearest) {
    told.push_back({CueKind::around,
                    {{}, std::max(0.0, thing->gap), thing->thing_class, side_of(thing->nearest)}});
    told.back().from = thing->nearest;
  }
  Utterance first = told.front();
  first.also.assign(told.begin() + 1, told.end());
  return first;
}

std::optional<Utterance> stops_before(const std::vector<NearThing>& nearby, double stops_in) {
  for (const NearThing& thing : nearby) {  // nearest first
    const double left = thing.gap - std::abs(stops_in);
    if (thing.nearest.x() * stops_in <= 0.0 || side_of_lane(thing.nearest) != Side::ahead) continue;
    if (left >= kAround) return std::nullopt;
    return Utterance{CueKind::stops_before, {{}, std::max(0.1, left), thing.thing_class}};
  }
  return std::nullopt;
}

Utterance near_words(const Content& content, ThingClass thing, Side side, bool urgent) {
  return {content, {{}, {}, thing, side}, urgent ? std::optional(Priority::message) : std::nullopt};
}

}  // namespace navvi_feedback::cues
