#include "haptics/rumble_output.hpp"

#include <algorithm>
#include <cmath>

namespace navvi_feedback::haptics {
namespace {

constexpr double kStep = 1.0 / 255.0;
constexpr double kJump = 0.2;
constexpr double kRecordPeriod = 0.05;  // s
constexpr double kRepeatPeriod = 0.1;   // s

bool off(const Rumble& rumble) { return rumble.left == 0.0 && rumble.right == 0.0; }

double difference(const Rumble& a, const Rumble& b) {
  return std::max(std::abs(a.left - b.left), std::abs(a.right - b.right));
}

bool elapsed(const std::optional<double>& then, double now, double span) {
  constexpr double kRounding = 1e-9;
  return !then || now - *then >= span - kRounding;
}

}  // namespace

RumbleOutput::Due RumbleOutput::update(const Rumble& rumble, double time) {
  const double step = difference(rumble, recorded_);
  Due due;
  due.changed = off(rumble) != off(recorded_) || step >= kJump ||
                (step >= kStep && elapsed(recorded_at_, time, kRecordPeriod));
  due.moved = difference(rumble, sent_) >= kStep || off(rumble) != off(sent_);
  due.feedback = due.moved || elapsed(sent_at_, time, kRepeatPeriod);
  if (due.changed) {
    recorded_ = rumble;
    recorded_at_ = time;
  }
  if (due.feedback) {
    sent_ = rumble;
    sent_at_ = time;
  }
  return due;
}

}  // namespace navvi_feedback::haptics
