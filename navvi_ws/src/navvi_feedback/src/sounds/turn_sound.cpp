#include "sounds/turn_sound.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::sounds {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// s, between two ticks: at next to nothing left, and at a right angle or more.
constexpr double kFastest = 0.10;
constexpr double kSlowest = 0.50;
constexpr double kMost = 90.0 * kDegree;
/// Of what a turn otherwise begins at.
constexpr double kFine = 0.5;
/// s, for which a heading must be off: a path that swings past is no reason to turn.
constexpr double kHold = 0.2;
/// rad/s; slower counts as not turning, and teaches nothing.
constexpr double kStill = 0.1;
constexpr double kTurning = 0.3;
/// m/s; slower counts as standing.
constexpr double kDriving = 0.1;
/// s; who turns on for so long does not obey.
constexpr double kObeys = 1.5;
/// Of what a turn teaches.
constexpr double kWeight = 0.3;
/// rad/s, the least that slowing down leaves.
constexpr double kLeast = 0.35;

double interval(double off) {
  return kFastest + (kSlowest - kFastest) * std::min(1.0, std::abs(off) / kMost);
}

}  // namespace

std::optional<Play> TurnSound::update(std::optional<double> off, bool fine, const Velocity& motion,
                                      double time) {
  const double rate = motion.angular;
  learn(off, rate, time);
  if (!off) {
    counting_ = false;
    off_since_.reset();
    return std::nullopt;
  }
  const Eigen::Vector2d side(0.0, *off > 0.0 ? -1.0 : 1.0);
  if (!counting_) {
    const double begin = fine ? std::max(kFine * config_.begin, config_.done) : config_.begin;
    if (std::abs(*off) <= begin * kDegree || stopping_)
      off_since_.reset();
    else if (!off_since_)
      off_since_ = time;
    if (!off_since_) return on_course(motion, time);
    if (time - *off_since_ < kHold) return std::nullopt;
    counting_ = true;
    off_since_.reset();
    ticked_.reset();
  }
  left_ = std::abs(*off);
  // Turning counter-clockwise makes what lies ahead wander clockwise.
  const double left = *off + rate * learnt_.stopping_delay;
  if (std::abs(left) <= config_.done * kDegree || left * *off < 0.0) {
    counting_ = false;
    if (std::abs(rate) > kStill) stopping_ = Stopping{time, rate, 0.0};
    left_ = 0.0;
    heard_ = time;
    return Play{Earcon::turn_stop, Eigen::Vector2d::UnitX(), config_.volume};
  }
  if (ticked_ && time - *ticked_ < interval(*off)) return std::nullopt;
  ticked_ = heard_ = time;
  return Play{Earcon::turn, side, config_.volume};
}

std::optional<Play> TurnSound::on_course(const Velocity& motion, double time) {
  if (std::abs(motion.linear) < kDriving) heard_ = time;
  if (config_.on_course <= 0.0 || time - heard_ < config_.on_course) return std::nullopt;
  heard_ = time;
  return Play{Earcon::on_course, Eigen::Vector2d::UnitX(), 0.5 * config_.volume};
}

void TurnSound::learn(std::optional<double> off, double rate, double time) {
  const double dt = time - time_;
  time_ = time;
  if (!stopping_) return;
  stopping_->angle += rate * dt;
  const bool stopped = std::abs(rate) < kStill || rate * stopping_->rate < 0.0;
  const bool obeyed = time - stopping_->since < kObeys;
  if (!stopped && obeyed) return;
  if (config_.learn && obeyed && std::abs(stopping_->rate) > kTurning) {
    const double took = std::clamp(stopping_->angle / stopping_->rate, 0.0, 1.0);
    learnt_.stopping_delay += kWeight * (took - learnt_.stopping_delay);
  }
  // The first turns count alike, later ones the less the older they are.
  if (off)
    learnt_.turn_error += std::max(kWeight, 1.0 / ++turns_) * (std::abs(*off) - learnt_.turn_error);
  stopping_.reset();
}

std::optional<double> TurnSound::most_rate() const {
  if (config_.slow_down <= 0.0 || (!counting_ && !stopping_)) return std::nullopt;
  return std::max(kLeast, left_ / config_.slow_down);
}

}  // namespace navvi_feedback::sounds
