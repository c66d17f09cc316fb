#include "navvi_sim/physics/robot.hpp"

#include <algorithm>

namespace navvi_sim::physics {

void RobotConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(radius, "radius", Range{0.1, 1.0}, "m", "radius of the hull");
  visit(max_speed, "max_speed", Range{0.05, 3.0}, "m/s", "largest speed, forward and back");
  visit.group("imperfections", imperfections);
}

double RobotState::forward_speed() const {
  return velocity.dot(Eigen::Vector2d(std::cos(yaw), std::sin(yaw)));
}

double RobotState::sideways_speed() const {
  return velocity.dot(Eigen::Vector2d(-std::sin(yaw), std::cos(yaw)));
}

navvi_types::Odometry RobotState::odometry(double floor, std::int64_t stamp) const {
  return {stamp, {position, yaw}, {forward_speed(), turn_rate}, sideways_speed(), floor};
}

navvi_types::Velocity servo(const RobotConfig& config, const navvi_types::Velocity& now,
                            const navvi_types::Velocity& command, Braking braking, double dt) {
  const bool hard = braking == Braking::emergency;
  const double linear = std::clamp(command.linear, -config.max_speed, config.max_speed);
  const double angular = std::clamp(command.angular, -config.max_turn_rate, config.max_turn_rate);
  using navvi_types::approach;
  return {approach(now.linear, linear, config.acceleration * dt,
                   (hard ? config.brake : config.deceleration) * dt),
          approach(now.angular, angular, config.angular_acceleration * dt,
                   (hard ? config.angular_brake : config.angular_acceleration) * dt)};
}

}  // namespace navvi_sim::physics
