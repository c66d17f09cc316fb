#include "lead/hand.hpp"

#include <cmath>

namespace navvi_feedback::lead {
namespace {

constexpr double kPulse = 0.15;     // s
constexpr double kQuick = 0.3;      // s, from one pulse to the next: drive as fast as you like
constexpr double kMedium = 0.5;     // s, at half the speed
constexpr double kSlow = 0.9;       // s, slowly
constexpr double kMuch = 0.55;      // share of the full speed, from which pulses are quick
constexpr double kSome = 0.25;      // likewise medium
constexpr double kLeast = 0.08;     // likewise slow; less is to stand
constexpr double kStraight = 0.12;  // rad; less is straight on
constexpr double kAmple = 0.41;     // rad; more is a strong pulse
// Below the force of the patterns, which have both motors at 0.8 or more.
constexpr double kWeak = 0.35;
constexpr double kStrong = 0.7;

double interval(double speed) { return speed > kMuch ? kQuick : speed > kSome ? kMedium : kSlow; }

haptics::Rumble pulse_of(double turn) {
  const double size = std::abs(turn);
  if (size <= kStraight) return {kWeak, kWeak};
  const double force = size > kAmple ? kStrong : kWeak;
  return turn > 0.0 ? haptics::Rumble{0.0, force} : haptics::Rumble{force, 0.0};
}

}  // namespace

haptics::Rumble HandPulses::update(std::optional<Course> course, double dt) {
  const bool stands = !course || course->speed < kLeast;
  if (!course || (stands && std::abs(course->turn) < kWorthTurning)) {
    *this = {};
    return {};
  }
  if (since_) *since_ += dt;
  if (stands || std::abs(course->turn) > kOnTheSpot) {
    pulse_ = pulse_of(course->turn);
    unbroken_ = true;
    since_ = 0.0;
    return pulse_;
  }
  // The end of what had no break is told by a pause.
  const double wait = unbroken_ ? kPulse : interval(course->speed);
  if (!since_ || *since_ >= wait) {
    since_ = 0.0;
    pulse_ = pulse_of(course->turn);
    unbroken_ = false;
  }
  return !unbroken_ && *since_ < kPulse ? pulse_ : haptics::Rumble{};
}

}  // namespace navvi_feedback::lead
