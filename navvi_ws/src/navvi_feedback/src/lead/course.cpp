#include "lead/course.hpp"

#include <algorithm>
#include <cmath>
#include <navvi_types/angles.hpp>

namespace navvi_feedback::lead {
namespace {

constexpr double kHalfLane = 0.6;     // m; what is farther to the side is passed at full speed
constexpr double kSqueezes = 0.37;    // m, likewise once the robot has stood for kPatience
constexpr double kPatience = 2.0;     // s
constexpr double kLongest = 8.0;      // s; what is still there then is taken to stand
constexpr double kKeeps = 0.25;       // m, from what stands ahead
constexpr double kKeepsMoving = 0.6;  // m, from what moves
constexpr double kBrakes = 1.0;       // s, over which what is left of the gap is driven
constexpr double kReaction = 1.5;     // s, that a person takes to a slower speed
constexpr double kAside = 1.7;        // s, over which what is left of the way to a wall is driven
constexpr double kCreep = 0.15;       // m/s, towards what stands: the path leads round it
constexpr double kNoticed = 0.08;     // m/s; what is slower is shown as to stand
constexpr double kBehind = -0.2;      // m, in base_link; what is farther back is passed
constexpr double kAway = 0.3;         // rad
constexpr double kDue = 0.1;          // rad; more is turned on the spot while the way is not free
constexpr double kPast = 0.35;        // rad, likewise past a thing that is nearer than kKeeps
// A steering person as the predictor has it: between the able and the struggling.
constexpr double kDelay = 0.6;     // s, from what is shown to the turn
constexpr double kGain = 1.0;      // 1/s, turn rate over what is shown
constexpr double kFastest = 1.0;   // rad/s
constexpr double kBeat = 0.1;      // s; what is not shown again for longer was shown no longer
constexpr double kBend = 0.5;      // share of the speed that an angle of kOnTheSpot takes
constexpr double kCorner = 0.15;   // share of the full speed at a right angle
constexpr double kBefore = 3.0;    // m, of way for the full speed more

/// m/s that what is ahead, within so many m to either side, allows.
/// \param from_moving  m, to be kept from what moves
double allowed(const std::vector<NearThing>& nearby, double half_lane, double from_moving,
               double beside, double speed, double full) {
  double most = full;
  for (const NearThing& thing : nearby) {
    if (!thing.moving && thing.nearest.x() > kBehind && thing.gap < beside)
      most = std::min(most, std::max(kCreep, full * thing.gap / beside));
    if (thing.nearest.x() <= 0.0) continue;
    const bool in_lane = std::abs(thing.nearest.y()) <= half_lane;
    if (!in_lane && (thing.moving || beside < kBesideByHand)) continue;
    // Along the nose, to a face beside the lane.
    const double way = in_lane ? thing.gap : thing.gap * thing.nearest.norm() / thing.nearest.x();
    // Whoever sets off is not shown what would be too fast a moment later.
    const double slow = (way - kKeeps) / (in_lane ? kBrakes + kReaction : kAside);
    const double keeps = from_moving + kReaction * std::max(0.0, speed);
    most = std::min(most, thing.moving ? std::max(0.0, (thing.gap - keeps) / kBrakes)
                                       : std::max(kCreep, slow));
  }
  return most;
}

/// rad, clockwise, away from what stands beside the robot and is all but touched.
double away(const std::vector<NearThing>& nearby, double beside) {
  double left = 0.0, right = 0.0;
  for (const NearThing& thing : nearby) {
    if (thing.moving || thing.gap >= beside || thing.nearest.x() < kBehind) continue;
    double& side = thing.nearest.y() > 0.0 ? left : right;
    side = std::max(side, kAway * (1.0 - std::max(0.0, thing.gap) / beside));
  }
  return left - right;
}

/// Share of the full speed that a turn and a corner ahead allow.
double bend(const Way& way, double left, double off) {
  if (off > kOnTheSpot) return 0.0;
  const double sharp = std::min(1.0, std::abs(way.turn) / (0.5 * navvi_types::kPi));
  const double corner = 1.0 - (1.0 - kCorner) * sharp + way.corner / kBefore;
  return std::min(corner, 1.0 - kBend * std::abs(left) / kOnTheSpot);
}

}  // namespace

haptics::Rumble flow_of(const Course& course) {
  const double sum = kSlowest + (1.0 - kSlowest) * std::clamp(course.speed, 0.0, 1.0);
  const double lean = std::clamp(course.turn / kFullTurn, -1.0, 1.0);
  return {0.5 * sum * (1.0 - lean), 0.5 * sum * (1.0 + lean)};
}

double Pilot::pending(double time) {
  while (!shown_.empty() && (shown_.front().first < time - kDelay || shown_.back().first > time))
    shown_.pop_front();
  double turn = 0.0, until = time;
  for (auto one = shown_.rbegin(); one != shown_.rend(); ++one) {
    const double rate = std::clamp(kGain * one->second, -kFastest, kFastest);
    turn += rate * std::min(kBeat, until - one->first);
    until = one->first;
  }
  return turn;
}

std::optional<Course> Pilot::update(const std::optional<Way>& way,
                                    const std::vector<NearThing>& nearby, double beside,
                                    double speed, double full, double time) {
  if (!way) {
    went_ = time;
    return std::nullopt;
  }
  const double left = navvi_types::wrap(way->off - pending(time));
  const double off = std::max(std::abs(way->off), std::abs(left));
  double free = allowed(nearby, kHalfLane, kKeepsMoving, beside, speed, full);
  if (free > kNoticed || !went_) went_ = time;
  if (const double waited = time - *went_; waited > kPatience) {
    const double from_moving = waited > kLongest ? kKeeps : kKeepsMoving;
    free = std::min(kCreep, allowed(nearby, kSqueezes, from_moving, beside, speed, full));
  }
  const bool before = std::any_of(nearby.begin(), nearby.end(), [](const NearThing& thing) {
    return thing.nearest.x() > 0.0 && thing.gap < kKeeps;
  });
  if (free <= kNoticed || (before && off > kPast)) free = 0.0;
  if (free <= 0.0 && std::abs(way->off) < kDue) return std::nullopt;
  const double aside = off < kOnTheSpot ? away(nearby, beside) : 0.0;
  const Course course{left + aside, std::min(bend(*way, left, off), free / full)};
  // A lesser turn on the spot is not felt.
  if (course.speed > 0.0 || std::abs(course.turn) >= kWorthTurning)
    shown_.emplace_back(time, course.turn);
  return course;
}

}  // namespace navvi_feedback::lead
