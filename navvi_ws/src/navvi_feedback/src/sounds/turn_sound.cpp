#include "sounds/turn_sound.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace navvi_feedback::sounds {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// Of what a turn teaches: of what it left, and of its stop.
constexpr double kWeight = 0.3;
constexpr double kStopWeight = 0.15;
constexpr double kLongestStop = 2.0;  // s
/// Standard deviations; a stop that is farther off was missed first, and teaches no more than this.
constexpr double kFarthest = 3.0;
constexpr double kLeastSpread = 0.05;  // s
/// Stops that what is set counts for: the first ones teach more than later ones.
constexpr int kBefore = 1;
/// Standard deviation over the mean deviation, where errors are normal.
constexpr double kNormal = 1.25;
constexpr double kMuch = 20.0 * kDegree;
/// Turns that leave much; one that leaves little makes up for one of them.
constexpr int kTooMany = 3;
constexpr int kLongestTrial = 32;

/// s, between two ticks: at next to nothing left, and at a right angle or more. Of sounds that
/// follow each other sooner one masks the other.
constexpr double kFastest = 0.20;
constexpr double kSlowest = 0.50;
constexpr double kMost = 90.0 * kDegree;
/// Of what a turn otherwise begins at.
constexpr double kFine = 0.5;
/// s, for which a heading must be off: a path that swings past is no reason to turn.
constexpr double kHold = 0.2;
/// rad/s; slower counts as not turning, and teaches nothing.
constexpr double kStill = 0.1;
constexpr double kTurning = 0.15;
/// m/s; slower counts as standing.
constexpr double kDriving = 0.1;
/// s; a longer turn does not respond to the sound.
constexpr double kObeys = 2.5;
/// s, between two sounds to stop at.
constexpr double kStopAgain = 0.35;
/// s; without a turn by then the ticks were missed.
constexpr double kMissed = 5.0;
/// rad, turned away from the ticks in one go: a turn that went the wrong way.
constexpr double kAway = 30.0 * kDegree;
/// rad, that stops may differ by from turn to turn: the end of a turn is led so slowly.
constexpr double kAlike = 4.5 * kDegree;
/// rad/s, the least that slowing down leaves before where the turn is to end, and beyond.
constexpr double kLeast = 0.2;
constexpr double kCrawl = 0.15;

double interval(double off) {
  return kFastest + (kSlowest - kFastest) * std::min(1.0, std::abs(off) / kMost);
}

}  // namespace

void TurnLearning::stopped(double took) {
  if (!learns_) return;
  took = std::clamp(took, 0.0, kLongestStop);
  const double farthest = kFarthest * std::max(kLeastSpread, learnt_.stopping_spread);
  const double off = std::clamp(took - learnt_.stopping_delay, -farthest, farthest);
  learnt_.stopping_delay += std::max(kStopWeight, 1.0 / (kBefore + ++stops_)) * off;
  learnt_.stopping_spread += kStopWeight * (kNormal * std::abs(off) - learnt_.stopping_spread);
}

void TurnLearning::led_by_sounds(double error) {
  // The first turns count alike, later ones the less the older they are.
  learnt_.turn_error += std::max(kWeight, 1.0 / ++turns_) * (error - learnt_.turn_error);
  if (!learns_) return;
  bad_ = std::max(0, bad_ + (error > kMuch ? 1 : -1));
  if (bad_ < kTooMany) return;
  learnt_.words_lead = true;
  by_words_ = 0;
}

void TurnLearning::turned(bool away) {
  if (!learns_) return;
  away_ = std::max(0, away_ + (away ? 1 : -1));
  if (away_ >= kTooMany) found_sides_wrong();
}

void TurnLearning::found_sides_wrong() { learnt_.words_lead = learnt_.sides_wrong = true; }

void TurnLearning::led_by_words(double error) {
  if (!learnt_.words_lead || learnt_.sides_wrong) return;
  by_words_ = error > kMuch ? 0 : by_words_ + 1;
  if (by_words_ < trial_) return;
  // Sounds are tried again; if that fails, not so soon the next time.
  learnt_.words_lead = false;
  bad_ = kTooMany - 1;
  trial_ = std::min(2 * trial_, kLongestTrial);
}

std::optional<Play> TurnSound::update(std::optional<double> off, bool fine, const Velocity& motion,
                                      double time) {
  const double dt = time - std::exchange(time_, time);
  learn(off, motion.angular, dt, time);
  if (!leads()) watch_words(off, motion.angular);
  if (!off || !leads()) {
    counting_.reset();
    off_since_.reset();
    return std::nullopt;
  }
  if (stopping_) return stop_again(time);
  if (!counting_ && !begins(*off, fine, time))
    return off_since_ ? std::nullopt : on_course(motion, time);
  return count(*off, motion.angular, dt, time);
}

bool TurnSound::begins(double off, bool fine, double time) {
  const double begin = fine ? std::max(kFine * config_.kBegin, config_.kDone) : config_.kBegin;
  if (std::abs(off) <= begin * kDegree) {
    off_since_.reset();
    return false;
  }
  if (!off_since_) off_since_ = time;
  if (time - *off_since_ < kHold) return false;
  counting_ = Counting{time, false, std::nullopt};
  off_since_.reset();
  return true;
}

std::optional<Play> TurnSound::count(double off, double rate, double dt, double time) {
  left_ = std::abs(off);
  const bool turns = std::abs(rate) > kTurning && rate * off < 0.0;
  if (turns) counting_->turned = true;
  const bool away = std::abs(rate) > kTurning && rate * off > 0.0;
  const double before = std::exchange(
      counting_->away, away ? counting_->away + std::abs(rate) * dt : 0.0);
  if (before <= kAway && counting_->away > kAway) {
    counting_->strayed = true;
    learning_.turned(true);
    if (!leads()) return std::nullopt;
  }
  if (!counting_->turned && time - counting_->since > kMissed) {
    learning_.led_by_sounds(left_);
    counting_->since = time;
    if (!leads()) return std::nullopt;
  }
  // Turning counter-clockwise makes what lies ahead wander clockwise.
  const double left = off + rate * learnt().stopping_delay;
  if (std::abs(left) <= config_.kDone * kDegree || left * off < 0.0) {
    if (counting_->turned && !counting_->strayed) learning_.turned(false);
    counting_.reset();
    if (std::abs(rate) > kStill) stopping_ = Stopping{time, rate, time, 0.0};
    heard_ = time;
    return Play{Earcon::turn_stop, Eigen::Vector2d::UnitX(), config_.volume};
  }
  if (counting_->ticked && time - *counting_->ticked < interval(off)) return std::nullopt;
  // Just before the sound to stop at a tick would mask it.
  if (turns && std::abs(left) - config_.kDone * kDegree < std::abs(rate) * kFastest)
    return std::nullopt;
  counting_->ticked = heard_ = time;
  const Eigen::Vector2d side(0.0, off > 0.0 ? -1.0 : 1.0);
  return Play{Earcon::turn, side, config_.volume};
}

/// Who missed it turns on.
std::optional<Play> TurnSound::stop_again(double time) {
  if (time - stopping_->told < kStopAgain) return std::nullopt;
  stopping_->told = heard_ = time;
  return Play{Earcon::turn_stop, Eigen::Vector2d::UnitX(), config_.volume};
}

std::optional<Play> TurnSound::on_course(const Velocity& motion, double time) {
  if (std::abs(motion.linear) < kDriving) heard_ = time;
  if (config_.kOnCourse <= 0.0 || time - heard_ < config_.kOnCourse) return std::nullopt;
  heard_ = time;
  return Play{Earcon::on_course, Eigen::Vector2d::UnitX(), 0.5 * config_.volume};
}

void TurnSound::learn(std::optional<double> off, double rate, double dt, double time) {
  if (!stopping_) return;
  stopping_->angle += rate * dt;
  // Turning counter-clockwise, what is left lies counter-clockwise.
  if (off) left_ = stopping_->rate > 0.0 ? -*off : *off;
  const bool stopped = std::abs(rate) < kStill || rate * stopping_->rate < 0.0;
  const bool obeyed = time - stopping_->since < kObeys;
  if (!stopped && obeyed) return;
  if (obeyed && std::abs(stopping_->rate) > kTurning)
    learning_.stopped(stopping_->angle / stopping_->rate);
  if (off) learning_.led_by_sounds(std::abs(*off));
  stopping_.reset();
}

void TurnSound::watch_words(std::optional<double> off, double rate) {
  if (std::abs(rate) > kTurning) turns_by_words_ = true;
  if (!turns_by_words_ || std::abs(rate) > kStill) return;
  turns_by_words_ = false;
  if (off) learning_.led_by_words(std::abs(*off));
}

double TurnSound::least_rate() const {
  return std::max(kLeast, kAlike / std::max(0.01, learnt().stopping_spread));
}

std::optional<double> TurnSound::most_rate() const {
  if (config_.slow_down <= 0.0 || (!counting_ && !stopping_)) return std::nullopt;
  if (stopping_ && left_ < 0.0) return std::min(kCrawl, least_rate());
  return std::max(least_rate(), left_ / config_.slow_down);
}

}  // namespace navvi_feedback::sounds
