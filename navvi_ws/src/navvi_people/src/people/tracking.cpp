#include "navvi_people/people/tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kFelt = 0.02;      // of a motor; each person's threshold was applied before
constexpr double kHard = 0.8;       // of both motors: a pattern
constexpr double kStrong = 0.5;     // of one motor
constexpr double kSlight = 0.27;    // rad, a weak pulse
constexpr double kAmple = 0.55;     // rad, a strong one
constexpr double kOnTheSpot = 0.9;  // rad, one without a break
constexpr double kUnbroken = 0.25;  // s
constexpr double kGone = 1.6;       // times the interval: there is no further pulse
constexpr double kLongest = 1.2;    // s, between two pulses

struct Pace {
  double interval;  ///< s, up to which
  double speed;     ///< share of the full speed
};
constexpr std::array<Pace, 3> kPaces = {{{0.4, 1.0}, {0.7, 0.5}, {kLongest, 0.17}}};

double speed_of(double interval) {
  for (const Pace& pace : kPaces)
    if (interval > 0.0 && interval <= pace.interval) return pace.speed;
  return kPaces.back().speed;
}

constexpr double kCrossover = 0.6;   // rad, crossover frequency times delay
constexpr double kQuickest = 2.0;    // 1/s, as the hand of those who see
constexpr double kAlike = 0.2;       // s, over which the remnant is alike
constexpr double kLeast = 0.035;     // rad, standard deviation where straight on is shown
constexpr double kLapse = 1.0;       // s
constexpr double kLapseShare = 0.3;  // of the turn that is shown

}  // namespace

void Pulses::feel(const Felt& felt, double time) {
  const bool was = std::max(last_.left, last_.right) > kFelt;
  const bool is = std::max(felt.left, felt.right) > kFelt;
  last_ = felt;
  on_ = is;
  if (!is || was) return;
  interval_ = begun_ && time - *begun_ <= kLongest ? time - *begun_ : 0.0;
  begun_ = time;
  pattern_ = std::min(felt.left, felt.right) >= kHard;
  const double lean = felt.right - felt.left;
  const bool both = std::min(felt.left, felt.right) > kFelt;
  const double size = std::max(felt.left, felt.right) > kStrong ? kAmple : kSlight;
  aim_ = {both ? 0.0 : std::copysign(size, lean), speed_of(interval_)};
}

std::optional<Aim> Pulses::update(double time) {
  if (!begun_ || pattern_) return std::nullopt;
  const bool one_side = std::min(last_.left, last_.right) <= kFelt;
  if (on_ && one_side && time - *begun_ > kUnbroken)
    return Aim{std::copysign(kOnTheSpot, aim_.turn), 0.0};
  const double next = interval_ > 0.0 ? kGone * interval_ : kLongest;
  if (!on_ && time - *begun_ > next) return std::nullopt;
  return aim_;
}

void Tracking::show(std::optional<Aim> aim, double time) {
  const auto same = [&](const Shown& last) {
    return last.aim.has_value() == aim.has_value() &&
           (!aim || (last.aim->turn == aim->turn && last.aim->speed == aim->speed));
  };
  if (shown_.empty() ? !aim : same(shown_.back())) return;
  shown_.push_back({time, aim});
}

std::optional<Aim> Tracking::shown(double time) const {
  const auto after = std::find_if(shown_.begin(), shown_.end(),
                                  [&](const Shown& one) { return one.time > time; });
  return after == shown_.begin() ? std::nullopt : std::prev(after)->aim;
}

double Tracking::gain() const {
  return std::min(kQuickest, kCrossover / std::max(0.01, lag_.steer));
}

/// The error drawn anew at each step, so that the same person errs alike whatever is shown.
Aim Tracking::mistaken(Aim aim, double time, double dt) {
  const double keeps = std::exp(-dt / kAlike);
  const double fresh = std::sqrt(1.0 - keeps * keeps);
  turn_error_ = keeps * turn_error_ + fresh * random_.normal();
  speed_error_ = keeps * speed_error_ + fresh * random_.normal();
  if (random_.chance(lag_.lapses * dt)) lapses_until_ = time + kLapse;
  if (!faults_) return aim;
  if (time < lapses_until_) aim.turn *= kLapseShare;
  if (lag_.noise > 0.0) aim.turn += turn_error_ * (lag_.noise * std::abs(aim.turn) + kLeast);
  aim.speed = std::max(0.0, aim.speed * (1.0 + lag_.noise * speed_error_));
  return aim;
}

std::optional<Aim> Tracking::update(double time, double dt, double distracted) {
  const double steer = lag_.steer + distracted;
  const double speed = std::max(lag_.speed, lag_.stop) + distracted;
  const std::optional<Aim> side = shown(time - steer);
  const std::optional<Aim> later = shown(time - speed);
  const std::optional<Aim> soon = shown(time - lag_.stop - distracted);
  while (shown_.size() > 2 && shown_[1].time < time - std::max(steer, speed) - 1.0)
    shown_.pop_front();
  const Aim followed =
      mistaken({side ? side->turn : 0.0,
                soon && later ? std::min(soon->speed, later->speed) : 0.0}, time, dt);
  if (!side || !soon) {
    since_.reset();
    return std::nullopt;
  }
  if (!since_) since_ = time;
  return followed;
}

}  // namespace navvi_people::people
