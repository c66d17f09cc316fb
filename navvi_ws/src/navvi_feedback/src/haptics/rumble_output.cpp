#include "navvi_feedback/haptics/rumble_output.hpp"

#include <cmath>

namespace navvi_feedback::haptics {
namespace {

constexpr double kStep = 1.0 / 255.0;
constexpr double kChangePeriod = 0.05;  // s
constexpr double kRepeatPeriod = 0.1;   // s

constexpr int kPulses = 3;
constexpr double kPulsePeriod = 0.5;  // s
constexpr double kPulseForce = 0.5;

bool off(const Rumble& rumble) { return rumble.left == 0.0 && rumble.right == 0.0; }

bool elapsed(const std::optional<double>& then, double now, double span) {
  constexpr double kRounding = 1e-9;
  return !then || now - *then >= span - kRounding;
}

}  // namespace

RumbleOutput::Due RumbleOutput::update(const Rumble& rumble, double time) {
  const bool differs = std::abs(rumble.left - sent_.left) >= kStep ||
                       std::abs(rumble.right - sent_.right) >= kStep || off(rumble) != off(sent_);
  Due due;
  due.changed = differs && (off(rumble) || elapsed(changed_at_, time, kChangePeriod));
  due.feedback = due.changed || elapsed(sent_at_, time, kRepeatPeriod);
  if (due.changed) changed_at_ = time;
  if (due.feedback) sent_at_ = time;
  if (due.changed) sent_ = rumble;
  return due;
}

double alarm_force(double since) {
  if (!(since >= 0.0) || since >= kPulses * kPulsePeriod) return 0.0;
  const double part = std::fmod(since, kPulsePeriod) / kPulsePeriod;
  // Half a sine wave in the first half of each period: no jolt at either end.
  return part < 0.5 ? kPulseForce * std::sin(2.0 * M_PI * part) : 0.0;
}

}  // namespace navvi_feedback::haptics
