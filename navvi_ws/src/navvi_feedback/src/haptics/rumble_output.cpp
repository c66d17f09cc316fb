#include "navvi_feedback/haptics/rumble_output.hpp"

#include <cmath>

namespace navvi_feedback::haptics {
namespace {

constexpr double kStep = 1.0 / 255.0;
constexpr double kChangePeriod = 0.05;  // s
constexpr double kRepeatPeriod = 0.1;   // s

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

}  // namespace navvi_feedback::haptics
