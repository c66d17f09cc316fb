#include "cues/halt.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::cues {
namespace {

/// s, for which the way must be clear.
constexpr double kClear = 0.8;
/// s; what is still there then must be driven round.
constexpr double kLongest = 8.0;
/// s, that "go on" waits for a direction.
constexpr double kDirection = 1.0;
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
  begin(time);
  heard_ = false;
  clear_since_.reset();
}

void Halt::repeat(double time) {
  if (said_ && time - *said_ < kLongest - kObeyed) last_ = time;
}

bool Halt::update(const Situation& now, bool follows, bool comes, double time) {
  if (!said_) return false;
  const bool may_go = follows && ((clear(now) && !comes) || time - *said_ > kLongest);
  if (!may_go) clear_since_.reset();
  if (may_go && !clear_since_) clear_since_ = time;
  if (time - last_ < kObeyed || !clear_since_ || time - *clear_since_ < kClear) return true;
  said_.reset();
  over_since_ = time;
  return false;
}

std::vector<Utterance> Halt::go_on(std::vector<Utterance> directions, bool sound, double time) {
  if (!over_since_ || said_) return directions;
  if (directions.empty() && !sound && time - *over_since_ < kDirection) return {};
  over_since_.reset();
  if (directions.empty()) return {{"go_on"}};
  Utterance& first = directions.front();
  // A new route, or to make room, is the end of a wait in words of its own.
  first.goes_on = first.kind != "make_room" && first.kind.find("route") == std::string::npos &&
                  first.kind != "way_blocked";
  first.priority = Priority::message;
  return directions;
}

}  // namespace navvi_feedback::cues
