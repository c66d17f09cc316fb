#include "navvi_people/people/tracking.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_people::people {
namespace {

constexpr double kCrossover = 0.6;   // rad, crossover frequency times delay
constexpr double kQuickest = 2.0;    // 1/s, as the hand of those who see
constexpr double kAlike = 0.2;       // s, over which the remnant is alike
constexpr double kLeast = 0.035;     // rad, standard deviation where straight on is shown
constexpr double kLapse = 1.0;       // s
constexpr double kLapseShare = 0.3;  // of the turn that is shown

}  // namespace

void TrackingConfig::describe(navvi_config::Visitor& visit) {
  visit(faults, "faults", navvi_config::Any{}, "",
        "false: a continuous display is followed late, but exactly");
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
