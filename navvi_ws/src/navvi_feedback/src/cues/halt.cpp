#include "cues/halt.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::cues {
namespace {

/// s; a person hears the word, and lets go of the stick.
constexpr double kObeyed = 2.0;
/// s, for which the way must be clear.
constexpr double kClear = 0.5;
/// s; what is still there then must be driven round.
constexpr double kLongest = 8.0;
/// m, gap
constexpr double kAhead = 1.0;
/// rad; who turns by so much does not drive at what is ahead.
constexpr double kAside = 0.5;

bool clear(const Situation& now) {
  if (now.guidance && std::abs(now.guidance->steer_angle) > kAside) return true;
  return std::none_of(now.nearby.begin(), now.nearby.end(), [](const NearThing& thing) {
    return thing.moving && thing.gap < kAhead && side_of_lane(thing.nearest) == Side::ahead;
  });
}

}  // namespace

void Halt::say(const Utterance& words, double time) {
  words_ = words;
  said_ = time;
  heard_ = false;
  clear_since_.reset();
}

bool Halt::update(const Situation& now, bool follows, double time) {
  if (!said_) return false;
  const bool may_go = follows && (clear(now) || time - *said_ > kLongest);
  if (!may_go) clear_since_.reset();
  if (may_go && !clear_since_) clear_since_ = time;
  if (time - *said_ >= kObeyed && clear_since_ && time - *clear_since_ >= kClear) said_.reset();
  return said_.has_value();
}

}  // namespace navvi_feedback::cues
