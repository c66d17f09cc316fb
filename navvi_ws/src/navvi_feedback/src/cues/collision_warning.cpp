#include "cues/collision_warning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cues/near_words.hpp"
#include "cues/surroundings.hpp"

namespace navvi_feedback::cues {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kShort = 0.2;    // s; a velocity is not known from less
constexpr double kMemory = 0.4;   // s
constexpr double kJump = 0.3;     // m; another part of the thing is nearest now
constexpr double kBrush = 0.05;   // m; a thing that is missed by less is touched
constexpr double kCreeps = 0.01;  // m/s; how a slower robot nears a thing is not known
constexpr double kPause = 0.5;    // s without an update; what was driven meanwhile is not known

/// s, until a point enters a circle as large as the robot on that side.
double until(const NearThing& thing, const Eigen::Vector2d& velocity) {
  const double speed2 = velocity.squaredNorm();
  const double closing = -thing.nearest.dot(velocity);
  if (closing <= 0.0 || speed2 < 1e-6) return kNever;
  const double radius = thing.nearest.norm() - thing.gap + kBrush;
  const double inside =
      closing * closing - speed2 * (thing.nearest.squaredNorm() - radius * radius);
  if (inside < 0.0) return kNever;
  return std::max(0.0, (closing - std::sqrt(inside)) / speed2);
}

/// s; a person who has not begun to turn by then has missed the corner.
constexpr double kLastMoment = 1.0;
/// s; that a thing comes is said again after so long at the earliest.
constexpr double kComes = 10.0;
/// s; a thing that was not about to be hit for so long is a new danger when it is.
constexpr double kOver = 1.0;
/// s to a collision; a person who has not kept off by then is to stop.
constexpr double kTooLate = 0.7;
/// s; what only turns past a robot that stands does not head for it for so long.
constexpr double kTurns = 0.4;
/// m/s, as a person begins to drive who was told to go on.
constexpr double kGoesOn = 0.6;
/// Of the time at which words are to stop.
constexpr double kLate = 0.5, kLateByHand = 0.75;
/// m, from a corner to what stands behind it.
constexpr double kBehindCorner = 0.5;

Velocity drives(const Observation& now) {
  const Velocity measured = now.measured.value_or(Velocity{});
  return std::abs(now.commanded.linear) > std::abs(measured.linear) ? now.commanded : measured;
}

}  // namespace

void CollisionForecast::update(const std::vector<NearThing>& nearby, double drives, double time) {
  if (time - time_ < kPause) driven_ += std::abs(drives) * (time - time_);
  time_ = time;
  std::map<std::uint32_t, std::vector<Seen>> seen;
  for (const NearThing& thing : nearby) {
    std::vector<Seen> track = std::move(seen_[thing.id]);
    if (!track.empty() && (track.back().point - thing.nearest).norm() > kJump) track.clear();
    // The same message may be looked at twice.
    if (track.empty() || track.back().point != thing.nearest)
      track.push_back({time, driven_, thing.nearest});
    while (time - track.front().time > kMemory && track.size() > 1) track.erase(track.begin());
    seen[thing.id] = std::move(track);
  }
  seen_ = std::move(seen);
}

std::optional<CollisionForecast::Motion> CollisionForecast::motion_of(
    const NearThing& thing) const {
  const auto seen = seen_.find(thing.id);
  if (seen == seen_.end()) return std::nullopt;
  const Seen& first = seen->second.front();
  const Seen& last = seen->second.back();
  const double passed = last.time - first.time;
  if (passed < kShort) return std::nullopt;
  return Motion{(last.point - first.point) / passed, (last.driven - first.driven) / passed};
}

double CollisionForecast::time_to_collision(const NearThing& thing, const Velocity& drives) const {
  if (thing.gap <= 0.0) return 0.0;
  const auto motion = motion_of(thing);
  double left = motion ? until(thing, motion->velocity) : kNever;
  if (thing.moving) return left;
  const double speed = std::abs(drives.linear);
  if (motion && motion->drives > kCreeps && motion->drives < speed) left *= motion->drives / speed;
  // As its point, seen from the robot, moves at this instant.
  const Eigen::Vector2d& point = thing.nearest;
  const Eigen::Vector2d turned = drives.angular * Eigen::Vector2d(point.y(), -point.x());
  return std::min(left, until(thing, turned - Eigen::Vector2d(drives.linear, 0.0)));
}

double CollisionForecast::time_once_driven(const NearThing& thing,
                                           const Eigen::Vector2d& velocity) const {
  if (thing.gap <= 0.0) return 0.0;
  const auto motion = motion_of(thing);
  return motion ? until(thing, motion->velocity - velocity) : kNever;
}

std::optional<CollisionWarning::Warning> CollisionWarning::update(const Observation& now,
                                                                  bool told_to_stop,
                                                                  const LastSaid& said,
                                                                  double time) {
  forecast_.update(now.nearby, now.measured ? now.measured->linear : 0.0, time);
  const std::optional<Danger> danger = soonest(now, time);
  if (!danger) return std::nullopt;
  const NearThing& thing = danger->thing;
  const Side side = side_of_lane(thing.nearest);
  const bool comes = thing.moving && !approaches(now, side);
  const bool same = last_.of == thing.id && time - last_.time < kComes;
  // A person who drives along a shelf is not told to stop for it again and again, but to keep off.
  const Utterance keep_off =
      near_words({CueKind::close, about(thing.thing_class)}, thing.thing_class, side, true);
  const bool along = same && last_.stop && !thing.moving && side != Side::ahead &&
                     danger->left > kTooLate && instead_of(keep_off, now.sounds);
  const Content told = comes   ? CueKind::obstacle_comes
                       : along ? Content(keep_off)
                               : CueKind::obstacle_stop;
  const bool lasts = same && last_.stop && !last_.keep_off && time - last_.danger < kOver;
  if (same) last_.danger = time;
  // News is another thing, one that comes after a danger that was over, or the way into it.
  const bool came = comes && (told_to_stop || (same && !last_.stop));
  if (said.too_soon(told, time) || came || lasts) return std::nullopt;
  last_ = {thing.id, time, time, !comes, along};
  return Warning{along ? keep_off : near_words(told, thing.thing_class, side, false), thing};
}

/// What will be hit first, if soon enough to be warned of.
std::optional<CollisionWarning::Danger> CollisionWarning::soonest(const Observation& now,
                                                                  double time) {
  std::optional<Danger> first;
  for (const NearThing& thing : now.nearby) {
    if (thing.gap <= 0.0 || (stands(now) && !thing.moving)) continue;
    const double left = forecast_.time_to_collision(thing, drives(now));
    const double limit = stop_time(now, thing);
    const bool steady = steadily(thing.id, left < limit + kTurns, time);
    if (limit <= 0.0 || left > limit || (first && left >= first->left)) continue;
    if (stands(now) && !steady) continue;
    first = {thing, left};
  }
  return first;
}

/// s, the time to collision at which the word is to stop.
double CollisionWarning::stop_time(const Observation& now, const NearThing& thing) const {
  // What leads all the time has slowed down and ended before.
  if (lasts(now.lead) && thing.moving) return kLate * config_.stop_moving;
  if (now.lead == Lead::flow) return kLate * config_.stop_standing;
  if (now.lead == Lead::hand) return kLateByHand * config_.stop_standing;
  if (thing.moving) return config_.stop_moving;
  const bool turns_off_before = now.guidance && now.guidance->is_followed() &&
                                now.guidance->waypoint_distance < thing.gap + kBehindCorner;
  return turns_off_before ? std::min(kLastMoment, config_.stop_standing) : config_.stop_standing;
}

/// \return whether it has headed for the robot for long enough
bool CollisionWarning::steadily(std::uint32_t thing, bool heads, double time) {
  if (!heads) headed_.erase(thing);
  return heads && time - headed_.emplace(thing, time).first->second >= kTurns;
}

bool CollisionWarning::comes(const Observation& now, double time) const {
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

}  // namespace navvi_feedback::cues
