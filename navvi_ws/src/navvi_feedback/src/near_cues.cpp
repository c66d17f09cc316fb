#include "navvi_feedback/near_cues.hpp"

#include <limits>

namespace navvi_feedback {
namespace {

/// m/s; slower counts as standing.
constexpr double kMoving = 0.05;

bool approaches(const Situation& now, Side side) {
  if (!now.measured) return false;
  if (side == Side::ahead) return now.measured->linear > kMoving;
  return side == Side::behind && now.measured->linear < -kMoving;
}

}  // namespace

void NearConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"distance", Range{0.1, 5.0}, "m", "gap at which a shelf or a wall is announced"},
        distance);
  visit({"close", Range{0.0, 5.0}, "m", "gap at which it is announced once more"}, close);
  visit({"hysteresis", Range{0.0, 1.0}, "m", "how much farther it must be to count as gone"},
        hysteresis);
  visit({"forget", Range{0.0, 30.0}, "s", "how long it must be gone to be announced again"},
        forget);
}

NearCues::Level NearCues::level(double gap, Level said) const {
  const double close = config_.close + (said == Level::close ? config_.hysteresis : 0.0);
  const double near = config_.distance + (said != Level::none ? config_.hysteresis : 0.0);
  if (gap <= close && gap <= near) return Level::close;
  return gap <= near ? Level::near : Level::none;
}

std::vector<Utterance> NearCues::update(const Situation& now, double time) {
  std::map<std::pair<ThingClass, Side>, double> gaps;
  for (const ThingClass thing : {ThingClass::shelf, ThingClass::wall})
    for (const Side side : {Side::ahead, Side::left, Side::behind, Side::right})
      gaps[{thing, side}] = std::numeric_limits<double>::infinity();
  for (const Nearby& thing : now.nearby) {
    const auto gap = gaps.find({thing.thing_class, side_of(thing.nearest)});
    if (gap != gaps.end() && thing.gap < gap->second) gap->second = thing.gap;
  }
  // A collision says where the thing is; nothing is left to add.
  for (const Situation::Contact& contact : now.contacts)
    if (const std::pair where{contact.thing_class, side_of(contact.point)}; gaps.count(where) > 0)
      watches_[where] = {Level::close, time};

  std::optional<Utterance> nearest;
  double nearest_gap = std::numeric_limits<double>::infinity();
  Watch* told = nullptr;
  Level told_level = Level::none;
  for (const auto& [where, gap] : gaps) {
    Watch& watch = watches_[where];
    const Level reached = level(gap, watch.said);
    if (reached >= watch.said) watch.last_near = time;
    if (reached < watch.said && time - watch.last_near > config_.forget) watch.said = reached;
    const auto [thing, side] = where;
    const bool urgent = approaches(now, side);
    if (reached <= watch.said || gap >= nearest_gap) continue;
    if (side == Side::behind && !urgent) continue;
    if (now.voice_busy && !urgent) continue;
    Fillings fillings;
    fillings.thing = thing;
    fillings.side = side;
    nearest = Utterance{thing == ThingClass::shelf ? "shelf_near" : "wall_near", fillings,
                        urgent ? std::optional(Priority::message) : std::nullopt};
    nearest_gap = gap;
    told = &watch;
    told_level = reached;
  }
  if (!nearest) return {};
  *told = {told_level, time};
  return {*nearest};
}

}  // namespace navvi_feedback
