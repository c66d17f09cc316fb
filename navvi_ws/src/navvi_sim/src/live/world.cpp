#include "navvi_sim/live/world.hpp"

#include <algorithm>
#include <cmath>

#include "description/hash.hpp"

namespace navvi_sim::live {
namespace {

constexpr double kCrushing = 0.01;  // m, deeper in the robot than this no mover pushes on
constexpr double kMaxPushed = 3.0;  // m/s, the fastest a mover can shove the robot

bool is_finite(const Eigen::Vector2d& v) { return v.allFinite(); }

}  // namespace

void WorldConfig::describe(navvi_config::Visitor& visit) {
  using navvi_config::Range;
  visit(step, "step", Range{0.001, 0.01}, "s", "fixed time step");
  visit(ceiling, "ceiling", Range{0.5, 10.0}, "m",
        "what begins higher above the floor is not near the robot");
  visit.group("robot", robot);
  visit.group("movers", movers);
}

World::World(const WorldDescription& description, const WorldConfig& config, const FloorPose& start,
             std::uint64_t seed)
    : config_(config),
      floor_height_(description.floor_height),
      traffic_(description, config.movers, seed),
      bodies_(description, description.floor_height + config.robot.clearance),
      physics_(bodies_, description.floor_height, config.robot, {start.x, start.y}, start.yaw),
      drivetrain_(config.robot, config.step, physics_.robot(), seed) {
  for (const Thing& thing : description.things) classes_.push_back(thing.thing_class);
  for (std::size_t i = 0; i < traffic_.size(); ++i) {
    const Thing& thing = description.things[traffic_.thing(i)];
    const double z = thing.pose.translation().z();
    stances_.push_back({tilt_of(thing.pose), z});
    const Footprint print = footprint_of(thing, stances_[i].tilt);
    now_.movers.push_back({traffic_.thing(i), Eigen::Isometry3d::Identity(), 0.0,
                           Eigen::Vector2d::Zero(), 0.0, extent_of(print),
                           z + print.top - floor_height_});
  }
  place_movers(true);
  take_snapshot();
}

World::Status World::step(const navvi_safety::Velocity& command, physics::Braking braking) {
  if (failed_) return Status::numeric_failure;
  if (!std::isfinite(command.linear) || !std::isfinite(command.angular))
    return Status::command_refused;

  const double speed = now_.robot.velocity.norm();
  // Bullet measures distances at the begin of a step and brakes the robot in the step that brings
  // it up to a thing. The touch is found one step later, when the speed has gone already.
  const double speed_before_contact = std::max(speed, last_speed_);
  last_speed_ = speed;
  step_movers();
  drive_robot(command, braking);
  physics_.advance(config_.step, now_.movers);
  drivetrain_.count(now_.robot, physics_.robot());
  ++steps_;
  take_snapshot();
  if (!finite()) {
    failed_ = true;
    return Status::numeric_failure;
  }
  now_.contacts =
      contacts_.update(physics_.touches(), classes_, speed_before_contact, config_.step);
  return Status::running;
}

std::vector<physics::NearThing> World::proximity(double detection_radius) const {
  const physics::RobotConfig& robot = config_.robot;
  const physics::Hull hull{now_.robot.position, robot.radius, floor_height_ + robot.clearance,
                           floor_height_ + robot.height};
  return physics::things_near(hull, detection_radius, floor_height_ + config_.ceiling, bodies_,
                              now_.movers);
}

void World::step_movers() {
  traffic_.step({now_.robot.position, config_.robot.radius, now_.robot.velocity}, pressing(),
                config_.step);
  place_movers(false);
}

/// Takes over what moved, or all.
void World::place_movers(bool all) {
  for (std::size_t i = 0; i < traffic_.size(); ++i) {
    const traffic::Mover& mover = traffic_.mover(i);
    MoverState& state = now_.movers[i];
    state.velocity = mover.velocity();
    state.turn_rate = mover.turn_rate();
    if (!all && !mover.has_moved()) continue;
    const traffic::Place& place = mover.place();
    if (all || place.yaw != state.yaw)
      state.pose.linear() =
          (Eigen::AngleAxisd(place.yaw, Eigen::Vector3d::UnitZ()) * stances_[i].tilt)
              .toRotationMatrix();
    state.yaw = place.yaw;
    state.pose.translation() << place.at, stances_[i].z;
  }
}

std::vector<std::size_t> World::pressing() const {
  const std::vector<physics::Touch>& touches = physics_.touches();
  std::vector<std::size_t> found;
  for (const physics::Touch& candidate : touches) {
    if (candidate.distance >= physics::ContactCounter::kTouching) continue;
    const bool deep = std::any_of(touches.begin(), touches.end(), [&](const physics::Touch& touch) {
      return touch.distance < (touch.thing == candidate.thing ? -kCrushing : -0.5 * kCrushing);
    });
    if (deep) found.push_back(candidate.thing);
  }
  return found;
}

/// The wheels take hold of the body anew in each step: they drive along its x axis and do not
/// slip sideways. What contact did to the body in the last step is where they start from.
void World::drive_robot(const navvi_safety::Velocity& command, physics::Braking braking) {
  const physics::RobotState& robot = now_.robot;
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
}

/// What moves follows its track, which is finite.
bool World::finite() const {
  const physics::RobotState& robot = now_.robot;
  return is_finite(robot.position) && is_finite(robot.velocity) && std::isfinite(robot.yaw) &&
         std::isfinite(robot.turn_rate);
}

std::uint64_t World::state_hash() const {
  std::uint64_t hash = mix(kHashBasis, static_cast<double>(steps_));
  hash = traffic_.hash(drivetrain_.hash(physics_.hash(hash)));
  for (const auto& [thing, apart] : contacts_.held())
    hash = mix(mix(hash, static_cast<double>(thing)), apart);
  for (const auto& [thing_class, count] : contacts_.counts())
    hash = mix(mix(hash, static_cast<double>(thing_class)), static_cast<double>(count));
  return hash;
}

}  // namespace navvi_sim::live
