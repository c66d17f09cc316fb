#include "cues/near_cues.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cues/structure.hpp"

namespace navvi_feedback::cues {
namespace {

/// m/s; slower counts as standing.
constexpr double kMoving = 0.05;
/// m, gap; what is farther is not around.
constexpr double kAround = 3.0;
/// s; a person who has not begun to turn by then has missed the corner.
constexpr double kLastMoment = 1.0;
/// s; that a thing comes is said again after so long at the earliest.
constexpr double kComes = 10.0;
/// s; a thing that was not about to be hit for so long is a new danger when it is.
constexpr double kOver = 1.0;
/// s to a collision; who has not kept off by then is to stop.
constexpr double kTooLate = 0.7;
/// s; what only turns past a robot that stands does not head for it for so long.
constexpr double kTurns = 0.4;
/// m/s, as a person begins to drive who was told to go on.
constexpr double kGoesOn = 0.6;
/// m, from a corner to what stands behind it.
constexpr double kBehindCorner = 0.5;

bool stands(const Situation& now) {
  return now.measured && std::abs(now.measured->linear) <= kMoving;
}

/// What the robot does, or is about to do.
Velocity drives(const Situation& now) {
  const Velocity measured = now.measured.value_or(Velocity{});
  return std::abs(now.commanded.linear) > std::abs(measured.linear) ? now.commanded : measured;
}

bool approaches(const Situation& now, Side side) {
  if (!now.measured) return false;
  if (side == Side::ahead) return now.measured->linear > kMoving;
  return side == Side::behind && now.measured->linear < -kMoving;
}

/// In the lane that the robot drives along, or, of what it may brush, beside it.
bool in_the_way(const Situation& now, const Eigen::Vector2d& point, bool close) {
  if (!now.measured || stands(now)) return false;
  const double forward = std::copysign(point.x(), point.x() * now.measured->linear);
  return forward >= 0.0 && (close || std::abs(point.y()) <= kHalfLane);
}

Utterance utterance(CueKind kind, ThingClass thing, Side side, bool urgent) {
  return {kind, {{}, {}, thing, side}, urgent ? std::optional(Priority::message) : std::nullopt};
}

CueKind close_kind(ThingClass thing) {
  if (thing == ThingClass::shelf) return CueKind::shelf_close;
  return thing == ThingClass::wall ? CueKind::wall_close : CueKind::obstacle_close;
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

bool NearCues::too_soon(CueKind kind, double time) const {
  const auto said = said_.find(kind);
  return said != said_.end() && time - said->second < traits(kind).min_interval;
}

std::vector<Utterance> NearCues::update(const Situation& now, bool all, Hold hold, double time) {
  hold_ = hold;
  forecast_.update(now.nearby, now.measured ? now.measured->linear : 0.0, time);
  std::optional<Candidate> best;
  consider_collisions(now, time, best);
  if (!best && all) {
    consider_sides(now, time, best);
    if (config_.obstacles) consider_things(now, time, best);
  }
  if (!best) return {};
  *best->watch = {best->level, time};
  said_[best->utterance.kind] = time;
  return {best->utterance};
}

/// s, the time to collision at which the word is to stop.
double NearCues::stop_time(const Situation& now, const NearThing& thing) const {
  if (thing.moving) return config_.stop_moving;
  const bool turns_off_before = now.guidance && now.guidance->is_followed() &&
                                now.guidance->waypoint_distance < thing.gap + kBehindCorner;
  return turns_off_before ? std::min(kLastMoment, config_.stop_standing) : config_.stop_standing;
}

/// \return whether it has headed for the robot for long enough
bool NearCues::steadily(std::uint32_t thing, bool heads, double time) {
  if (!heads) headed_.erase(thing);
  return heads && time - headed_.emplace(thing, time).first->second >= kTurns;
}

void NearCues::consider_collisions(const Situation& now, double time,
                                   std::optional<Candidate>& best) {
  const NearThing* first = nullptr;
  double soonest = std::numeric_limits<double>::infinity();
  for (const NearThing& thing : now.nearby) {
    if (thing.gap <= 0.0 || (stands(now) && !thing.moving)) continue;
    const double left = forecast_.time_to_collision(thing, drives(now));
    const double limit = stop_time(now, thing);
    const bool steady = steadily(thing.id, left < limit + kTurns, time);
    if (limit <= 0.0 || left > limit || left >= soonest) continue;
    if (stands(now) && !steady) continue;
    soonest = left;
    first = &thing;
  }
  if (first == nullptr) return;
  const Side side = side_of_lane(first->nearest);
  const bool comes = first->moving && !approaches(now, side);
  const bool same = warned_of_ == first->id && time - warned_ < kComes;
  // Who drives along a shelf is not told to stop for it again and again, but to keep off.
  const Utterance keep_off =
      utterance(close_kind(first->thing_class), first->thing_class, side, true);
  const bool along = same && warned_stop_ && !first->moving && side != Side::ahead &&
                     soonest > kTooLate && instead_of(keep_off, now.sounds);
  const CueKind kind = comes   ? CueKind::obstacle_comes
                       : along ? keep_off.kind
                               : CueKind::obstacle_stop;
  const bool lasts = same && warned_stop_ && !kept_off_ && time - danger_ < kOver;
  if (same) danger_ = time;
  // News is another thing, one that comes after a danger that was over, or the way into it.
  const bool came = comes && (hold_.comes || (same && !warned_stop_));
  if (too_soon(kind, time) || came || lasts) return;
  warned_of_ = first->id;
  warned_ = danger_ = time;
  warned_stop_ = !comes;
  kept_off_ = along;
  best = Candidate{along ? keep_off : utterance(kind, first->thing_class, side, false), first->gap,
                   &things_[first->id], Level::close};
  // A side of which this was said needs no more words, either.
  watches_[{first->thing_class, side}] = {Level::close, time};
}

bool NearCues::comes(const Situation& now, double time) const {
  if (config_.stop_moving <= 0.0) return false;
  const double steer = now.guidance ? now.guidance->steer_angle : 0.0;
  const Eigen::Vector2d led = kGoesOn * Eigen::Vector2d(std::cos(steer), -std::sin(steer));
  return std::any_of(now.nearby.begin(), now.nearby.end(), [&](const NearThing& thing) {
    if (thing.gap <= 0.0) return false;
    double left = forecast_.time_to_collision(thing, drives(now));
    if (!thing.moving) return !stands(now) && left < config_.stop_standing + time;
    if (stands(now)) left = std::min(left, forecast_.time_once_driven(thing, led));
    return left < config_.stop_moving + time;
  });
}

void NearCues::unsaid(CueKind kind) {
  said_.erase(kind);
  if (kind == CueKind::obstacle_stop || kind == CueKind::obstacle_comes) warned_of_.reset();
}

void NearCues::consider_sides(const Situation& now, double time, std::optional<Candidate>& best) {
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
    if ((now.voice_busy && !urgent) || (hold_.ahead && side == Side::ahead))
      if (!now.sounds.shelf) continue;
    const CueKind kind = reached == Level::close      ? close_kind(thing)
                         : thing == ThingClass::shelf ? CueKind::shelf_near
                                                      : CueKind::wall_near;
    if (too_soon(kind, time)) continue;
    best = Candidate{utterance(kind, thing, side, urgent), gap, &watch, reached};
  }
}

void NearCues::consider_things(const Situation& now, double time, std::optional<Candidate>& best) {
  for (const Contact& contact : now.contacts) things_[contact.id] = {Level::close, time};
  for (auto thing = things_.begin(); thing != things_.end();)
    thing = time - thing->second.last_near > config_.forget ? things_.erase(thing) : ++thing;
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
    if ((now.voice_busy && !urgent) || (hold_.ahead && side == Side::ahead))
      if (!now.sounds.near) continue;
    const CueKind kind = close ? CueKind::obstacle_close : CueKind::obstacle_near;
    if (too_soon(kind, time) || (best && thing.gap >= best->gap)) continue;
    best = Candidate{utterance(kind, thing.thing_class, side, urgent), thing.gap, &watch, reached};
  }
}

sounds::Earcon earcon_of(ThingClass thing) {
  using sounds::Earcon;
  switch (thing) {
    case ThingClass::shelf:
    case ThingClass::wall:
      return Earcon::shelf_near;
    case ThingClass::worker:
      return Earcon::worker_near;
    case ThingClass::forklift:
      return Earcon::forklift_near;
    case ThingClass::pallet_robot:
      return Earcon::pallet_robot_near;
    default:
      return Earcon::thing_near;
  }
}

std::optional<sounds::Play> instead_of(const Utterance& utterance, const Sounds& sounds) {
  using sounds::Earcon;
  if (!is_near(family_of(utterance.kind))) return std::nullopt;
  const bool close = family_of(utterance.kind) == Family::close;
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
  if (nearest.empty()) return {CueKind::around_nothing};
  std::rotate(nearest.begin(), std::min_element(nearest.begin(), nearest.end(), nearer),
              nearest.end());
  std::vector<Utterance> told;
  for (const NearThing* thing : nearest) {
    told.push_back({CueKind::around, {{}, {}, thing->thing_class, side_of(thing->nearest)}});
    told.back().from = thing->nearest;
  }
  Utterance first = told.front();
  first.also.assign(told.begin() + 1, told.end());
  return first;
}

}  // namespace navvi_feedback::cues
