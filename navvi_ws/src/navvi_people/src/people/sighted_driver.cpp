#include "navvi_people/people/sighted_driver.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kReaction = 0.25;    // s, from the eye to the hand
constexpr double kStart = 1.0;        // s, hands off
constexpr double kSteers = 2.0;       // 1/s, turn rate over the angle to turn
constexpr double kOnTheSpot = 0.7;    // rad; more is turned standing
constexpr double kHalfLane = 0.45;    // m, and
constexpr double kSqueezes = 0.37;    // m, past what waits for the robot itself
constexpr double kPatience = 2.0;     // s, standing
constexpr double kKeeps = 0.25;       // m, from what is ahead, and
constexpr double kKeepsMoving = 0.6;  // m, from what moves
constexpr double kTakes = 1.0;        // s, to brake over what is left of that
constexpr double kCreep = 0.15;       // m/s, towards what stands: the path leads round it

/// m/s that what is ahead, within so many m to either side, allows.
double allowed(const std::vector<navvi_types::NearThing>& nearby, double half_lane, double full) {
  double most = full;
  for (const navvi_types::NearThing& thing : nearby) {
    if (thing.nearest.x() <= 0.0 || std::abs(thing.nearest.y()) > half_lane) continue;
    const double free = thing.gap - (thing.moving ? kKeepsMoving : kKeeps);
    most = std::min(most, std::max(thing.moving ? 0.0 : kCreep, free / kTakes));
  }
  return most;
}

}  // namespace

StickAndButtons SightedDriver::update(const Sight& sight, double time, double dt) {
  seen_.push_back({time, sight});
  while (seen_.size() > 1 && seen_[1].time <= time - kReaction) seen_.pop_front();
  const navvi_types::Guidance& way = seen_.front().sight.guidance;
  if (time < kStart || !way.is_followed()) {
    halted_ = time;
    return {};
  }
  const double off = way.steer_angle;
  const double full = driving_.shaped(config_.cruise) * config_.kFullSpeed;
  const double bend = std::max(0.0, 1.0 - std::abs(off) / kOnTheSpot);
  StickAndButtons hand;
  hand.left = driving_.stick_for(-kSteers * off / config_.kTurnRate);
  const std::vector<navvi_types::NearThing>& nearby = seen_.front().sight.nearby;
  double speed = allowed(nearby, kHalfLane, bend * full);
  if (speed > 0.0) halted_ = time;
  if (time - halted_ > kPatience) speed = std::min(kCreep, allowed(nearby, kSqueezes, bend * full));
  hand.forward = driving_.stick_for(speed / config_.kFullSpeed);
  if (std::abs(off) > kOnTheSpot) hand.forward = 0.0;
  hand.left = driving_.trembling(hand.left, dt);
  hand.forward = driving_.trembling(hand.forward, dt);
  return hand;
}

}  // namespace navvi_people::people
