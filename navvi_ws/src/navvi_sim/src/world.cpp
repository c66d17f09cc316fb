#include "navvi_sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navvi_sim {
namespace {

constexpr double kForesight = 1.5;  // s, how far ahead movers give way to those with right of way
constexpr double kCrushing = 0.01;  // m, deeper in the robot than this no mover pushes on
constexpr double kMaxPushed = 3.0;  // m/s, the fastest a mover can shove the robot

std::uint64_t mix(std::uint64_t hash, double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return (hash ^ bits) * 0x100000001B3ull;
}

bool is_finite(const Eigen::Vector2d& v) { return v.allFinite(); }

}  // namespace

void WorldConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit({"step", Range{0.001, 0.01}, "s", "fixed time step"}, step);
  visit({"ceiling", Range{0.5, 10.0}, "m",
         "what begins higher above the floor is not near the robot"},
        ceiling);
  visit.group("robot", robot);
  visit.group("movers", movers);
}

World::World(const WorldDescription& description, const WorldConfig& config, const FloorPose& start,
             std::uint64_t seed)
    : config_(config),
      floor_height_(description.floor_height),
      things_(description.things),
      physics_(description, config.robot, {start.x, start.y}, start.yaw),
      drivetrain_(config.robot, config.step, physics_.robot(), seed) {
  for (std::size_t id = 0; id < things_.size(); ++id)
    if (things_[id].route) movers_.emplace_back(id, things_[id], config.movers, seed);
  take_snapshot();
}

World::Status World::step(const navvi_safety::Velocity& command, Braking braking) {
  if (failed_) return Status::numeric_failure;
  if (!std::isfinite(command.linear) || !std::isfinite(command.angular))
    return Status::command_refused;

  const double speed_before = std::max(now_.robot.velocity.norm(), speed_before_);
  speed_before_ = now_.robot.velocity.norm();
  step_movers();
  drive_robot(command, braking);
  physics_.advance(config_.step);
  drivetrain_.count(now_.robot, physics_.robot());
  ++steps_;
  touches_ = physics_.touches();
  take_snapshot();
  if (!finite()) {
    failed_ = true;
    return Status::numeric_failure;
  }
  now_.contacts = contacts_.update(touches_, things_, speed_before, config_.step);
  return Status::running;
}

std::vector<NearThing> World::proximity(double detection_radius) const {
  return physics_.proximity(detection_radius, config_.ceiling);
}

/// Lower ids have right of way. All look at the same instant, so their order does not matter.
void World::step_movers() {
  const std::vector<Mover> before = movers_;
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    Mover::Surroundings around;
    around.robot = {now_.robot.position, config_.robot.radius};
    for (std::size_t other = 0; other < before.size(); ++other) {
      if (other == i) continue;
      const Mover& mover = before[other];
      const Disc disc{mover.position(), mover.footprint().radius};
      if (other > i) {
        around.rest.push_back(disc);
      } else {
        around.first.push_back(disc);
        around.first.push_back({disc.centre + kForesight * mover.velocity(), disc.radius});
      }
    }
    around.pushing_back = crushes(movers_[i].id());
    movers_[i].step(around, config_.step);
    physics_.move_thing(movers_[i].id(), movers_[i].pose());
  }
}

/// True if the thing presses the robot so far into itself or into another thing that the robot
/// cannot give way.
bool World::crushes(std::size_t thing) const {
  bool touching = false, deep = false;
  for (const Touch& touch : touches_) {
    touching = touching || (touch.thing == thing && touch.distance < ContactCounter::kTouching);
    deep = deep || touch.distance < (touch.thing == thing ? -kCrushing : -0.5 * kCrushing);
  }
  return touching && deep;
}

/// The wheels take hold of the body anew in each step: they drive along its x axis and do not
/// slip sideways. What contact did to the body in the last step is where they start from.
void World::drive_robot(const navvi_safety::Velocity& command, Braking braking) {
  const RobotState& robot = now_.robot;
  const double limit = kMaxPushed;
  const navvi_safety::Velocity measured{std::clamp(robot.forward_speed(), -limit, limit),
                                        robot.turn_rate};
  const navvi_safety::Velocity wheels = drivetrain_.drive(measured, command, braking);
  physics_.set_robot_velocity(
      wheels.linear * Eigen::Vector2d(std::cos(robot.yaw), std::sin(robot.yaw)), wheels.angular);
}

void World::take_snapshot() {
  now_.time = static_cast<double>(steps_) * config_.step;
  now_.robot = physics_.robot();
  now_.odometry = drivetrain_.odometry();
  now_.contacts.clear();
  now_.movers.clear();
  for (const Mover& mover : movers_)
    now_.movers.push_back(
        {mover.id(), mover.pose(), mover.yaw(), mover.velocity(), mover.turn_rate(),
         mover.footprint().radius,
         things_[mover.id()].pose.translation().z() + mover.footprint().top - floor_height_});
}

bool World::finite() const {
  const RobotState& robot = now_.robot;
  return is_finite(robot.position) && is_finite(robot.velocity) && std::isfinite(robot.yaw) &&
         std::isfinite(robot.turn_rate) &&
         std::all_of(now_.movers.begin(), now_.movers.end(), [](const MoverState& mover) {
           return mover.pose.matrix().allFinite() && is_finite(mover.velocity);
         });
}

std::uint64_t World::state_hash() const {
  std::uint64_t hash = mix(0xCBF29CE484222325ull, static_cast<double>(steps_));
  hash = drivetrain_.hash(physics_.hash(hash));
  for (const Mover& mover : movers_)
    for (const double value :
         {mover.position().x(), mover.position().y(), mover.yaw(), mover.speed(), mover.turn_rate(),
          mover.pause_left(), static_cast<double>(mover.target())})
      hash = mix(hash, value);
  for (const auto& [thing, apart] : contacts_.held())
    hash = mix(mix(hash, static_cast<double>(thing)), apart);
  for (const auto& [thing_class, count] : contacts_.counts())
    hash = mix(mix(hash, static_cast<double>(thing_class)), static_cast<double>(count));
  return hash;
}

}  // namespace navvi_sim
