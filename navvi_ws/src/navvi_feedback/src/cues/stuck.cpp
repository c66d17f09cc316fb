#include "cues/stuck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cues/clock_face.hpp"
#include "cues/near_cues.hpp"
#include "cues/side.hpp"

namespace navvi_feedback::cues {
namespace {

/// m; what is less far ahead is beside.
constexpr double kBeside = 0.05;

/// rad, clockwise from the nose
double angle_of(int hour) { return hour * kHourDegrees * M_PI / 180.0; }

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

}  // namespace

std::optional<Utterance> Stuck::update(const Situation& now, bool follows, double time) {
  // Commands near the thresholds may well move the robot more slowly than these.
  const bool commanded = std::abs(now.commanded.linear) > 2.0 * config_.stuck_linear ||
                         std::abs(now.commanded.angular) > 2.0 * config_.stuck_angular;
  const bool still = now.measured && std::abs(now.measured->linear) < config_.stuck_linear &&
                     std::abs(now.measured->angular) < config_.stuck_angular;
  const bool held =
      now.gate == DriveState::State::stopped || now.gate == DriveState::State::waiting;
  if (!commanded || !still || held) {
    since_.reset();
    said_.reset();
    return std::nullopt;
  }
  if (!since_) since_ = time;
  if (time - *since_ <= config_.stuck_time) return std::nullopt;
  if (said_ && time - *said_ < config_.stuck_repeat) return std::nullopt;
  said_ = time;

  // What lies where the person wants to go blocks more than what is merely nearer.
  const NearThing* blocker = nullptr;
  const auto rank = [&](const NearThing& thing) {
    const bool in_the_way = thing.nearest.x() * now.commanded.linear >= 0.0;
    return std::make_pair(in_the_way ? 0 : 1, thing.gap);
  };
  for (const NearThing& thing : now.nearby)
    if (thing.gap <= config_.blocker_gap && (!blocker || rank(thing) < rank(*blocker)))
      blocker = &thing;
  if (!blocker) return Utterance{CueKind::stuck_unknown};
  Fillings fillings{{}, {}, blocker->thing_class, side_of(blocker->nearest)};
  const auto free = [&](int hour) { return is_free(hour, now.nearby, config_.blocker_gap); };
  if (fillings.side == Side::ahead && free(6)) return Utterance{CueKind::back_away, fillings};
  const double wanted = follows ? now.guidance->steer_angle : 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int hour = 1; hour <= 12; ++hour) {
    const double aside = std::abs(std::remainder(angle_of(hour) - wanted, 2.0 * M_PI));
    if (aside >= least || !free(hour)) continue;
    least = aside;
    fillings.hour = hour;
  }
  if (fillings.hour) return Utterance{CueKind::stuck, fillings};
  Utterance boxed_in{CueKind::stuck_unknown};
  const Utterance sides = around(now.nearby);
  boxed_in.also = sides.also;
  boxed_in.also.insert(boxed_in.also.begin(), sides);
  for (Utterance& side : boxed_in.also) side.from.reset();  // words alone are sooner over
  return boxed_in;
}

}  // namespace navvi_feedback::cues
