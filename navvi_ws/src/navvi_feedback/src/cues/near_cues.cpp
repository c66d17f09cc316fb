#include "cues/near_cues.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_feedback::cues {
namespace {

/// m/s; slower counts as standing.
constexpr double kMoving = 0.05;

bool approaches(const Situation& now, Side side) {
  if (!now.measured) return false;
  if (side == Side::ahead) return now.measured->linear > kMoving;
  return side == Side::behind && now.measured->linear < -kMoving;
}

/// Less than 60 degrees off the way in which the robot drives, or, of what it may brush, 90.
bool in_the_way(const Situation& now, const Eigen::Vector2d& point, bool close) {
  if (!now.measured || std::abs(now.measured->linear) <= kMoving) return false;
  const double forward = std::copysign(point.x(), point.x() * now.measured->linear);
  return forward >= (close ? 0.0 : 0.5 * point.norm());
}

Utterance utterance(const char* kind, ThingClass thing, Side side, bool urgent) {
  return {kind, {{}, {}, thing, side}, urgent ? std::optional(Priority::message) : std::nullopt};
}

}  // namespace

NearCues::Level NearCues::level(double gap, Level said) const {
  const double close = config_.close + (said == Level::close ? config_.hysteresis : 0.0);
  const double near = config_.distance + (said != Level::none ? config_.hysteresis : 0.0);
  if (gap <= close && gap <= near) return Level::close;
  return gap <= near ? Level::near : Level::none;
}

NearCues::Level NearCues::observe(Watch& watch, double gap, double time) const {
  const Level reached = level(gap, watch.said);
  if (reached >= watch.said) watch.last_near = time;
  if (reached < watch.said && time - watch.last_near > config_.forget) watch.said = reached;
  return reached;
}

bool NearCues::too_soon(const std::string& kind, double time) const {
  const auto said = said_.find(kind);
  return said != said_.end() && time - said->second < cue_kind(kind).min_interval;
}

std::vector<Utterance> NearCues::update(const Situation& now, double time) {
  std::optional<Candidate> best;
  consider_sides(now, time, best);
  if (config_.obstacles) consider_things(now, time, best);
  if (!best) return {};
  *best->watch = {best->level, time};
  said_[best->utterance.kind] = time;
  return {best->utterance};
}

void NearCues::consider_sides(const Situation& now, double time, std::optional<Candidate>& best) {
  std::map<std::pair<ThingClass, Side>, double> gaps;
  for (const ThingClass thing : {ThingClass::shelf, ThingClass::wall})
    for (const Side side : {Side::ahead, Side::left, Side::behind, Side::right})
      gaps[{thing, side}] = std::numeric_limits<double>::infinity();
  for (const NearThing& thing : now.nearby) {
    const auto gap = gaps.find({thing.thing_class, side_of(thing.nearest)});
    if (gap != gaps.end() && thing.gap < gap->second) gap->second = thing.gap;
  }
  // A collision says where the thing is; nothing is left to add.
  for (const Contact& contact : now.contacts)
    if (const std::pair where{contact.thing_class, side_of(contact.seen_from_robot())};
        gaps.count(where) > 0)
      watches_[where] = {Level::close, time};

  for (const auto& [where, gap] : gaps) {
    Watch& watch = watches_[where];
    const Level reached = observe(watch, gap, time);
    const auto [thing, side] = where;
    const bool urgent = approaches(now, side);
    if (reached <= watch.said || (best && gap >= best->gap)) continue;
    if (side == Side::behind && !urgent) continue;
    if (now.voice_busy && !urgent) continue;
    const bool shelf = thing == ThingClass::shelf;
    const char* kind = reached == Level::close ? (shelf ? "shelf_close" : "wall_close")
                                               : (shelf ? "shelf_near" : "wall_near");
    if (too_soon(kind, time)) continue;
    best = Candidate{utterance(kind, thing, side, urgent), gap, &watch, reached};
  }
}

void NearCues::consider_things(const Situation& now, double time, std::optional<Candidate>& best) {
  for (const Contact& contact : now.contacts) things_[contact.id] = {Level::close, time};
  for (auto thing = things_.begin(); thing != things_.end();)
    thing = time - thing->second.last_near > config_.forget ? things_.erase(thing) : ++thing;
  for (const NearThing& thing : now.nearby) {
    if (thing.thing_class == ThingClass::shelf || thing.thing_class == ThingClass::wall) continue;
    const auto known = things_.find(thing.id);
    if (known == things_.end() && level(thing.gap, Level::none) == Level::none) continue;
    Watch& watch = known == things_.end() ? things_[thing.id] : known->second;
    // What moves may turn and come nearer still.
    const Level most = thing.moving ? Level::close : Level::near;
    const Level reached = std::min(observe(watch, thing.gap, time), most);
    const bool close = reached == Level::close;
    if (reached <= watch.said || !in_the_way(now, thing.nearest, close)) continue;
    const Side side = side_of(thing.nearest);
    const bool urgent = approaches(now, side);
    if (now.voice_busy && !urgent) continue;
    const char* kind = !close                ? "obstacle_near"
                       : side == Side::ahead ? "obstacle_stop"
                                             : "obstacle_close";
    if (too_soon(kind, time) || (best && thing.gap >= best->gap)) continue;
    best = Candidate{utterance(kind, thing.thing_class, side, urgent), thing.gap, &watch, reached};
  }
}

}  // namespace navvi_feedback::cues
