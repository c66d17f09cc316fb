#include "physics/wheel_odometry.hpp"

#include <cmath>

#include "description/hash.hpp"

namespace navvi_sim::physics {
namespace {

constexpr double kWheelBase = 0.5;  // m, between the two wheels

Eigen::Vector2d heading(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }

/// What the body does, if the wheels do this; m and rad, or m/s and rad/s.
navvi_types::Velocity body_of(double left, double right) {
  return {0.5 * (left + right), (right - left) / kWheelBase};
}

}  // namespace

void ImperfectionsConfig::describe(navvi_config::Visitor& visit) {
  visit(odometry_left, "odometry_left", navvi_config::Range{-0.2, 0.2}, "",
        "share by which odometry counts the left wheel's way too long");
  visit(odometry_noise, "odometry_noise", navvi_config::Range{0.0, 0.1}, "m per root of a metre",
        "standard deviation of each wheel's counted way; grows with the root of the way");
}

/// A shove aside goes unseen; what turns the wheels is counted, be it the motor or a push.
void WheelOdometry::count(const RobotState& before, const RobotState& after) {
  if (!flaws_.odometry_drifts()) {
    now_ = after;
    return;
  }
  const double turned = wrapped(after.yaw - before.yaw);
  const double way = (after.position - before.position).dot(heading(before.yaw + 0.5 * turned));
  const double apart = 0.5 * kWheelBase * turned;
  double left = (way - apart) * (1.0 + flaws_.odometry_left);
  double right = way + apart;
  const navvi_types::Velocity speed = body_of(left / step_, right / step_);
  if (flaws_.odometry_noise > 0.0) {
    left += flaws_.odometry_noise * std::sqrt(std::abs(left)) * normal();
    right += flaws_.odometry_noise * std::sqrt(std::abs(right)) * normal();
  }
  const navvi_types::Velocity moved = body_of(left, right);
  now_.position += moved.linear * heading(now_.yaw + 0.5 * moved.angular);
  now_.yaw = wrapped(now_.yaw + moved.angular);
  now_.velocity = speed.linear * heading(now_.yaw);
  now_.turn_rate = speed.angular;
}

std::uint64_t WheelOdometry::hash(std::uint64_t hash) const {
  if (flaws_.odometry_drifts())
    for (const double value : {now_.position.x(), now_.position.y(), now_.yaw})
      hash = mix(hash, value);
  return hash;
}

/// Nearly normal, and with any library the same: the sum of twelve uniform numbers.
double WheelOdometry::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_() >> 11) * 0x1.0p-53;
  return sum;
}

}  // namespace navvi_sim::physics
