#include "navvi_sim/live/world.hpp"

#include <algorithm>

#include "description/footprint.hpp"
#include "description/hash.hpp"
#include "physics/physics.hpp"
#include "physics/proximity.hpp"
#include "physics/wheel_odometry.hpp"
#include "traffic/traffic.hpp"

namespace navvi_sim::live {

constexpr double kCrushing = 0.01;  // m, deeper in the robot than this no mover pushes on
constexpr double kMaxPushed = 3.0;  // m/s, the fastest a mover can shove the robot

void WorldConfig::describe(navvi_config::Visitor& visit) {
  visit(wait_for_robot, "wait_for_robot", navvi_config::Any{}, "",
        "the traffic stands until the robot is first driven, so that it is the same however long "
        "a person waits before that");
  visit.group("robot", robot);
}

/// What makes the world move.
struct World::Parts {
  /// What does not change of a moving thing's pose.
  struct Stance {
    Eigen::Quaterniond tilt;
    double z;  ///< m
  };

  Parts(const WorldDescription& description, const WorldConfig& config, const Pose2& start,
        std::uint64_t seed)
      : traffic(description, config.movers, seed),
        bodies(description, description.floor_height + config.robot.clearance),
        physics(bodies, description.floor_height, config.robot, start.position, start.yaw),
        odometry(config.robot.imperfections, config.step, physics.robot(), seed) {
    for (const Thing& thing : description.things) {
      classes.push_back(obstacle_class(thing));
      names.push_back(thing.name);
    }
  }

  std::vector<ThingClass> classes;  ///< by thing
  std::vector<std::string> names;   ///< by thing
  traffic::Traffic traffic;
  std::vector<Stance> stances;  ///< by index in traffic
  physics::Bodies bodies;
  physics::Physics physics;
  physics::WheelOdometry odometry;
  physics::ContactCounter contacts;
};

World::World(const WorldDescription& description, const WorldConfig& config, const Pose2& start,
             std::uint64_t seed)
    : config_(config),
      floor_height_(description.floor_height),
      parts_(std::make_unique<Parts>(description, config, start, seed)) {
  for (std::size_t i = 0; i < parts_->traffic.size(); ++i) {
    const std::size_t id = parts_->traffic.thing(i);
    const Thing& thing = description.things[id];
    const double z = thing.pose.translation().z();
    parts_->stances.push_back({tilt_of(thing.pose), z});
    const Footprint print = footprint_of(thing, parts_->stances[i].tilt);
    MoverState& state = now_.movers.emplace_back();
    state.thing = extent_of(print);
    state.thing.id = static_cast<std::uint32_t>(id);
    state.thing.thing_class = thing.thing_class;
    state.thing.height = z + print.top - floor_height_;
    state.thing.floor = floor_height_;
  }
  place_movers(true);
  take_snapshot();
}

World::~World() = default;

World::Status World::step(const navvi_types::Velocity& command, physics::Braking braking) {
  if (failed_) return Status::numeric_failure;
  if (!std::isfinite(command.linear) || !std::isfinite(command.angular))
    return Status::command_refused;
  driven_ = driven_ || command.linear != 0.0 || command.angular != 0.0;
  if (config_.wait_for_robot && !driven_) {
    ++steps_;
    take_snapshot();
    return Status::running;
  }

  const double speed = now_.robot.velocity.norm();
  // Bullet measures distances at the begin of a step and brakes the robot in the step that brings
  // it up to a thing. The touch is found one step later, when the speed has gone already.
  const double speed_before_contact = std::max(speed, last_speed_);
  last_speed_ = speed;
  step_movers();
  drive_robot(command, braking);
  parts_->physics.advance(config_.step, now_.movers);
  parts_->odometry.count(now_.robot, parts_->physics.robot());
  ++steps_;
  take_snapshot();
  if (!finite()) {
    failed_ = true;
    return Status::numeric_failure;
  }
  count_contacts(speed_before_contact);
  return Status::running;
}

/// \param speed  m/s, the robot's before any contact that begins now
void World::count_contacts(double speed) {
  now_.contacts =
      parts_->contacts.update(parts_->physics.touches(), parts_->classes, speed, config_.step);
  for (navvi_types::Contact& contact : now_.contacts) {
    contact.name = parts_->names[contact.id];
    contact.robot = {now_.robot.position, now_.robot.yaw};
    contact.floor = floor_height_;
    contact.stamp = now_.stamp();
  }
}

navvi_types::Odometry World::odometry() const {
  return now_.odometry.odometry(floor_height_, now_.stamp());
}

navvi_types::Obstacles World::obstacles() const {
  navvi_types::Obstacles obstacles{now_.stamp(), {}};
  obstacles.things.reserve(now_.movers.size());
  for (const MoverState& mover : now_.movers) obstacles.things.push_back(mover.thing);
  return obstacles;
}

navvi_types::Proximity World::proximity(double detection_radius) const {
  const physics::RobotConfig& robot = config_.robot;
  const physics::Hull hull{now_.robot.position, robot.radius, floor_height_ + robot.clearance,
                           floor_height_ + robot.height};
  Eigen::Isometry3d base_link = Eigen::Isometry3d::Identity();
  base_link.translate(
      Eigen::Vector3d(now_.robot.position.x(), now_.robot.position.y(), floor_height_));
  base_link.rotate(Eigen::AngleAxisd(now_.robot.yaw, Eigen::Vector3d::UnitZ()));
  navvi_types::Proximity proximity{now_.stamp(), {}, detection_radius};
  for (const physics::ThingGap& near :
       physics::things_near(hull, detection_radius, parts_->bodies, now_.movers)) {
    const Eigen::Vector3d nearest = base_link.inverse() * near.nearest;
    proximity.things.push_back({parts_->classes[near.thing], static_cast<std::uint32_t>(near.thing),
                                near.gap, nearest.head<2>(), parts_->bodies.of(near.thing)->moves,
                                parts_->names[near.thing], nearest.z()});
  }
  return proximity;
}

void World::step_movers() {
  parts_->traffic.step({now_.robot.position, config_.robot.radius, now_.robot.velocity}, pressing(),
                       config_.step);
  place_movers(false);
}

/// Takes over what moved, or all.
void World::place_movers(bool all) {
  for (std::size_t i = 0; i < parts_->traffic.size(); ++i) {
    const traffic::Mover& mover = parts_->traffic.mover(i);
    MoverState& state = now_.movers[i];
    state.thing.velocity = mover.velocity();
    if (!all && !mover.has_moved()) continue;
    const Pose2& place = mover.place();
    if (all || place.yaw != state.thing.pose.yaw)
      state.pose.linear() =
          (Eigen::AngleAxisd(place.yaw, Eigen::Vector3d::UnitZ()) * parts_->stances[i].tilt)
              .toRotationMatrix();
    state.thing.pose = place;
    state.pose.translation() << place.position, parts_->stances[i].z;
  }
}

std::vector<std::size_t> World::pressing() const {
  const std::vector<physics::Touch>& touches = parts_->physics.touches();
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
void World::drive_robot(const navvi_types::Velocity& command, physics::Braking braking) {
  const physics::RobotState& robot = now_.robot;
  const navvi_types::Velocity measured{std::clamp(robot.forward_speed(), -kMaxPushed, kMaxPushed),
                                       robot.turn_rate};
  const navvi_types::Velocity wheels =
      physics::servo(config_.robot, measured, command, braking, config_.step);
  parts_->physics.set_robot_velocity(
      wheels.linear * Eigen::Vector2d(std::cos(robot.yaw), std::sin(robot.yaw)), wheels.angular);
}

void World::take_snapshot() {
  now_.time = static_cast<double>(steps_) * config_.step;
  now_.robot = parts_->physics.robot();
  now_.odometry = parts_->odometry.now();
  now_.contacts.clear();
}

/// What moves follows its track, which is finite.
bool World::finite() const {
  const physics::RobotState& robot = now_.robot;
  return robot.position.allFinite() && robot.velocity.allFinite() && std::isfinite(robot.yaw) &&
         std::isfinite(robot.turn_rate);
}

std::uint64_t World::state_hash() const {
  std::uint64_t hash = mix(kHashBasis, static_cast<double>(steps_));
  hash = parts_->traffic.hash(parts_->odometry.hash(parts_->physics.hash(hash)));
  for (const auto& [thing, apart] : parts_->contacts.held())
    hash = mix(mix(hash, static_cast<double>(thing)), apart);
  for (const auto& [thing_class, count] : parts_->contacts.counts())
    hash = mix(mix(hash, static_cast<double>(thing_class)), static_cast<double>(count));
  return hash;
}

}  // namespace navvi_sim::live
