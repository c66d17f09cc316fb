#include "physics/drivetrain.hpp"

#include <algorithm>
#include <cmath>

#include "description/hash.hpp"

namespace navvi_sim::physics {
namespace {

constexpr double kLeastGrip = 0.05;

Eigen::Vector2d heading(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }

/// rad, in (-pi, pi]
double wrapped(double angle) { return std::atan2(std::sin(angle), std::cos(angle)); }

}  // namespace

void ImperfectionsConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(slip_left, "slip_left", Range{0.0, 0.9}, "",
        "share of its turning that the left wheel loses");
  visit(slip_right, "slip_right", Range{0.0, 0.9}, "",
        "share of its turning that the right wheel loses");
  visit(slip_noise, "slip_noise", Range{0.0, 0.5}, "",
        "standard deviation of what comes on top and goes, each wheel by itself");
  visit(command_delay, "command_delay", Range{0.0, 2.0}, "s",
        "from a command to the wheels; an emergency stop is never late");
  visit(odometry_left, "odometry_left", Range{-0.2, 0.2}, "",
        "share by which odometry counts the left wheel's way too long");
  visit(odometry_right, "odometry_right", Range{-0.2, 0.2}, "",
        "share by which odometry counts the right wheel's way too long");
  visit(odometry_noise, "odometry_noise", Range{0.0, 0.1}, "m per root of a metre",
        "standard deviation of each wheel's counted way; grows with the root of the way");
}

Drivetrain::Drivetrain(const RobotConfig& config, double step, const RobotState& start,
                       std::uint64_t seed)
    : config_(config),
      flaws_(config.imperfections),
      step_(step),
      random_(seed),
      under_way_(static_cast<std::size_t>(std::lround(flaws_.command_delay / step))),
      odometry_(start) {
  draw_slip();
}

navvi_types::Velocity Drivetrain::drive(const navvi_types::Velocity& body,
                                        const navvi_types::Velocity& command, Braking braking) {
  const navvi_types::Velocity asked = late(command, braking);
  if (!flaws_.slips()) return servo(config_, body, asked, braking, step_);
  // The servo feels the wheels, not the floor.
  const Pair floor = wheels_of(body.linear, body.angular);
  const Pair turning{floor.left / grip_.left, floor.right / grip_.right};
  const navvi_types::Velocity next = servo(config_, body_of(turning), asked, braking, step_);
  draw_slip();
  const Pair wheels = wheels_of(next.linear, next.angular);
  return body_of({wheels.left * grip_.left, wheels.right * grip_.right});
}

/// A shove aside goes unseen; what turns the wheels is counted, be it the motor or a push.
void Drivetrain::count(const RobotState& before, const RobotState& after) {
  if (!flaws_.odometry_drifts()) {
    odometry_ = after;
    return;
  }
  const double turned = wrapped(after.yaw - before.yaw);
  const double way = (after.position - before.position).dot(heading(before.yaw + 0.5 * turned));
  const Pair floor = wheels_of(way, turned);
  Pair counted{floor.left / grip_.left * (1.0 + flaws_.odometry_left),
               floor.right / grip_.right * (1.0 + flaws_.odometry_right)};
  const navvi_types::Velocity speed = body_of({counted.left / step_, counted.right / step_});
  if (flaws_.odometry_noise > 0.0) {
    counted.left += flaws_.odometry_noise * std::sqrt(std::abs(counted.left)) * normal();
    counted.right += flaws_.odometry_noise * std::sqrt(std::abs(counted.right)) * normal();
  }
  const navvi_types::Velocity moved = body_of(counted);
  odometry_.position += moved.linear * heading(odometry_.yaw + 0.5 * moved.angular);
  odometry_.yaw = wrapped(odometry_.yaw + moved.angular);
  odometry_.velocity = speed.linear * heading(odometry_.yaw);
  odometry_.turn_rate = speed.angular;
}

std::uint64_t Drivetrain::hash(std::uint64_t hash) const {
  for (const navvi_types::Velocity& command : under_way_)
    hash = mix(mix(hash, command.linear), command.angular);
  if (flaws_.slips())
    for (const double value : {noise_.left, noise_.right, grip_.left, grip_.right})
      hash = mix(hash, value);
  if (flaws_.odometry_drifts())
    for (const double value : {odometry_.position.x(), odometry_.position.y(), odometry_.yaw})
      hash = mix(hash, value);
  return hash;
}

Drivetrain::Pair Drivetrain::wheels_of(double forward, double turn) const {
  const double apart = 0.5 * flaws_.wheel_base * turn;
  return {forward - apart, forward + apart};
}

navvi_types::Velocity Drivetrain::body_of(const Pair& wheels) const {
  return {0.5 * (wheels.left + wheels.right), (wheels.right - wheels.left) / flaws_.wheel_base};
}

navvi_types::Velocity Drivetrain::late(const navvi_types::Velocity& command, Braking braking) {
  if (under_way_.empty()) return command;
  if (braking == Braking::emergency) {
    std::fill(under_way_.begin(), under_way_.end(), navvi_types::Velocity{});
    return command;
  }
  under_way_.push_back(command);
  const navvi_types::Velocity due = under_way_.front();
  under_way_.pop_front();
  return due;
}

/// The noise is a Gauss-Markov process of first order, so that it has one size whatever the step.
void Drivetrain::draw_slip() {
  if (flaws_.slip_noise > 0.0) {
    const double kept = 1.0 - std::min(1.0, step_ / flaws_.slip_time);
    const double fresh = flaws_.slip_noise * std::sqrt(1.0 - kept * kept);
    noise_.left = kept * noise_.left + fresh * normal();
    noise_.right = kept * noise_.right + fresh * normal();
  }
  grip_.left = std::max(kLeastGrip, 1.0 - flaws_.slip_left - noise_.left);
  grip_.right = std::max(kLeastGrip, 1.0 - flaws_.slip_right - noise_.right);
}

/// Nearly normal, and with any library the same: the sum of twelve uniform numbers.
double Drivetrain::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_() >> 11) * 0x1.0p-53;
  return sum;
}

}  // namespace navvi_sim::physics
