#include "cues/near_cues.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cues/near_words.hpp"
#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {
namespace {

/// In the lane that the robot drives along, or, of what it may brush, beside it.
bool in_the_way(const Observation& now, const Eigen::Vector2d& point, bool close) {
  if (!now.measured || stands(now)) return false;
  const double forward = std::copysign(point.x(), point.x() * now.measured->linear);
  return forward >= 0.0 && (close || std::abs(point.y()) <= kHalfLane);
}

}  // namespace

NearCues::Level NearCues::level(double gap, Level said) const {
  const double close = config_.kClose + (said == Level::close ? config_.kHysteresis : 0.0);
  const double near = config_.distance + (said != Level::none ? config_.kHysteresis : 0.0);
  if (gap <= close && gap <= near) return Level::close;
  return gap <= near ? Level::near : Level::none;
}

NearCues::Level NearCues::observe(Watch& watch, double gap, double time) const {
  const Level reached = level(gap, watch.said);
  if (reached >= watch.said) watch.last_near = time;
  if (reached < watch.said && time - watch.last_near > config_.kForget) watch.said = reached;
  return reached;
}

Utterances NearCues::update(const Observation& now, bool all, Hold hold, double time) {
  if (const auto warning = warning_.update(now, hold.comes, said_, time)) {
    const NearThing& thing = warning->thing;
    // A side of which this was said needs no more words, either.
    things_[thing.id] =
        watches_[{thing.thing_class, side_of_lane(thing.nearest)}] = {Level::close, time};
    said_.note(warning->utterance, time);
    return {warning->utterance};
  }
  std::optional<Candidate> best;
  if (all) consider_sides(now, hold.ahead, time, best);
  if (all && config_.obstacles) consider_things(now, hold.ahead, time, best);
  if (!best) return {};
  *best->watch = {best->level, time};
  said_.note(best->utterance, time);
  return {best->utterance};
}

void NearCues::unsaid(const Content& content) {
  said_.forget(content);
  if (content == CueKind::obstacle_stop || content == CueKind::obstacle_comes) warning_.lost();
}

void NearCues::consider_sides(const Observation& now, bool straight, double time,
                              std::optional<Candidate>& best) {
  std::map<std::pair<ThingClass, Side>, double> gaps;
  for (const ThingClass thing : {ThingClass::shelf, ThingClass::wall})
    for (const Side side : {Side::ahead, Side::left, Side::behind, Side::right})
      gaps[{thing, side}] = std::numeric_limits<double>::infinity();
  for (const NearThing& thing : now.nearby) {
    const auto gap = gaps.find({thing.thing_class, side_of_lane(thing.nearest)});
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
    if ((now.voice_busy && !urgent) || (straight && side == Side::ahead))
      if (!now.sounds.shelf) continue;
    const Content told(reached == Level::close ? CueKind::close : CueKind::near, about(thing));
    if (said_.too_soon(told, time)) continue;
    best = Candidate{near_words(told, thing, side, urgent), gap, &watch, reached};
  }
}

void NearCues::consider_things(const Observation& now, bool straight, double time,
                               std::optional<Candidate>& best) {
  for (const Contact& contact : now.contacts) things_[contact.id] = {Level::close, time};
  for (auto thing = things_.begin(); thing != things_.end();)
    thing = time - thing->second.last_near > config_.kForget ? things_.erase(thing) : ++thing;
  for (const NearThing& thing : now.nearby) {
    if (is_structure(thing.thing_class)) continue;
    const auto known = things_.find(thing.id);
    if (known == things_.end() && level(thing.gap, Level::none) == Level::none) continue;
    Watch& watch = known == things_.end() ? things_[thing.id] : known->second;
    // What moves may turn and come nearer still.
    const Level most = thing.moving ? Level::close : Level::near;
    const Level reached = std::min(observe(watch, thing.gap, time), most);
    const bool close = reached == Level::close;
    if (reached <= watch.said || !in_the_way(now, thing.nearest, close)) continue;
    const Side side = side_of_lane(thing.nearest);
    const bool urgent = approaches(now, side);
    if ((now.voice_busy && !urgent) || (straight && side == Side::ahead))
      if (!now.sounds.near) continue;
    const Content told(close ? CueKind::close : CueKind::near, About::obstacle);
    if (said_.too_soon(told, time) || (best && thing.gap >= best->gap)) continue;
    best = Candidate{near_words(told, thing.thing_class, side, urgent), thing.gap, &watch, reached};
  }
}

}  // namespace navvi_feedback::cues
