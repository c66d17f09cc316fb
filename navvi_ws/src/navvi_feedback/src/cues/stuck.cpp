#include "cues/stuck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <navvi_types/angles.hpp>
#include <utility>

#include "cues/clock_face.hpp"
#include "cues/near_words.hpp"
#include "cues/side.hpp"

namespace navvi_feedback::cues {
namespace {

/// m; what is less far ahead is beside.
constexpr double kBeside = 0.05;

/// rad, clockwise from the nose
double angle_of(int hour) { return hour * kHourDegrees * navvi_types::kPi / 180.0; }

/// Whether a robot that turned there could drive on.
bool is_free(int hour, const std::vector<NearThing>& nearby, double gap) {
  const double angle = angle_of(hour);
  const Eigen::Vector2d way(std::cos(angle), -std::sin(angle));
  return std::none_of(nearby.begin(), nearby.end(), [&](const NearThing& thing) {
    const Eigen::Vector2d& at = thing.nearest;
    const double across = way.x() * at.y() - way.y() * at.x();
    return thing.gap <= gap && way.dot(at) > kBeside && std::abs(across) <= kHalfLane;
  });
}

/// What holds the robot: what lies where the person wants to go rather than what is merely nearer.
const NearThing* blocker_of(const Observation& now, double gap) {
  const NearThing* blocker = nullptr;
  const auto rank = [&](const NearThing& thing) {
    const bool in_the_way = thing.nearest.x() * now.commanded.linear >= 0.0;
    return std::make_pair(in_the_way ? 0 : 1, thing.gap);
  };
  for (const NearThing& thing : now.nearby)
    if (thing.gap <= gap && (!blocker || rank(thing) < rank(*blocker))) blocker = &thing;
  return blocker;
}

/// The free hour nearest to an angle, rad; nullopt if there is none.
std::optional<int> free_hour(const std::vector<NearThing>& nearby, double gap, double wanted) {
  std::optional<int> best;
  double least = std::numeric_limits<double>::infinity();
  for (int hour = 1; hour <= 12; ++hour) {
    const double aside = std::abs(navvi_types::wrap(angle_of(hour) - wanted));
    if (aside >= least || !is_free(hour, nearby, gap)) continue;
    least = aside;
    best = hour;
  }
  return best;
}

Utterance boxed_in(const std::vector<NearThing>& nearby) {
  Utterance told{CueKind::stuck_unknown};
  const Utterance sides = around(nearby);
  told.also = sides.also;
  told.also.insert(told.also.begin(), sides);
  for (Utterance& side : told.also) {
    // Few words alone are sooner over.
    side.from.reset();
    if (side.kind == CueKind::around) side.about = About::side;
  }
  return told;
}

}  // namespace

Utterances Stuck::update(const Observation& now, bool follows, double time) {
  // Commands near the thresholds may well move the robot more slowly than these.
  const bool commanded = std::abs(now.commanded.linear) > 2.0 * config_.kStuckLinear ||
                         std::abs(now.commanded.angular) > 2.0 * config_.kStuckAngular;
  const bool still = now.measured && std::abs(now.measured->linear) < config_.kStuckLinear &&
                     std::abs(now.measured->angular) < config_.kStuckAngular;
  const bool held =
      now.gate == DriveState::State::stopped || now.gate == DriveState::State::waiting;
  if (!commanded || !still || held) {
    since_.reset();
    said_.reset();
    return {};
  }
  if (!since_) since_ = time;
  if (time - *since_ <= config_.stuck_time) return {};
  if (said_ && time - *said_ < config_.stuck_repeat) return {};
  said_ = time;
  return {words(now, follows)};
}

Utterance Stuck::words(const Observation& now, bool follows) const {
  const double gap = config_.kBlockerGap;
  const NearThing* blocker = blocker_of(now, gap);
  if (!blocker) return {CueKind::stuck_unknown};
  Fillings fillings{{}, {}, blocker->thing_class, side_of(blocker->nearest)};
  if (fillings.side == Side::ahead && is_free(6, now.nearby, gap))
    return {CueKind::back_away, fillings};
  fillings.hour = free_hour(now.nearby, gap, follows ? now.guidance->steer_angle : 0.0);
  if (fillings.hour == 6) return {CueKind::back_away, fillings};
  if (fillings.hour) return {CueKind::stuck, fillings};
  return boxed_in(now.nearby);
}

}  // namespace navvi_feedback::cues
