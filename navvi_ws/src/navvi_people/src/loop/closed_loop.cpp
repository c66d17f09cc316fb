#include "navvi_people/loop/closed_loop.hpp"

#include <navvi_config/reader.hpp>
#include <navvi_feedback/node/msg_conversion.hpp>
#include <navvi_sim/node/msg_conversion.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <stdexcept>
#include <utility>

#include "node/msg_conversion.hpp"

namespace navvi_people::loop {
namespace {

constexpr double kNavigationRate = 20.0;  // Hz, of nav_node's timer and of the obstacles
constexpr double kFeedbackRate = 50.0;    // Hz, of feedback_node's and operator_node's
constexpr double kMapBy = 30.0;  // s; a robot's own sensors have shown some floor long before
constexpr double kLinkRate = 2.0;          // Hz, of what the gate reports of the connection
constexpr double kGoalAt = 1.0;  // s; trial_node sets the goal when every part is there

/// With the height that the path leads under, as perception_node takes it.
navvi_perception::see::PerceptionConfig perception_of(const ClosedLoopConfig& config) {
  navvi_perception::see::PerceptionConfig perception = config.perception;
  perception.set_robot_height(config.nav.robot_height());
  return perception;
}

/// \throws ConfigError where the path may lead under what the robot hits
const ClosedLoopConfig& with_headroom(const ClosedLoopConfig& config) {
  if (config.nav.robot_height() < navvi_types::kHeadroom)
    throw navvi_config::ConfigError(
        "nav/mesh/robot_height is less than 0.8 m, the height of the simulated robot; allowed is "
        "that or more.");
  return config;
}

}  // namespace

ClosedLoopConfig::ClosedLoopConfig() {
  navvi_config::read(nav, navvi_config::read_words({"mesh/climb:=0"}), "the closed loop");
}

void ClosedLoopConfig::describe(navvi_config::Visitor& visit) {
  visit.group("sim", sim);
  visit.group("nav", nav);
  visit.group("feedback", feedback);
  visit.group("person", person);
  visit.group("perception", perception);
  visit(speech, "speech", navvi_config::Any{}, "", "false: nothing is spoken");
  visit(driver, "driver", navvi_config::OneOf{{"person", "sighted"}}, "",
        "sighted: the sighted reference, with the person's hand and preferred speed");
}

ClosedLoop::Setting::Setting(const ClosedLoopConfig& config, const navvi_files::Cache* cache)
    : world(navvi_sim::setup::load_world(config.sim).world),
      course(navvi_sim::setup::course_of(config.sim, world, cache)) {
  if (config.sim.sensing != "truth")
    senses.emplace(config.sim, perception_of(config), world,
                   navvi_sim::setup::map_of(config.sim, world));
}

ClosedLoop::ClosedLoop(const ClosedLoopConfig& config, const Spoken& spoken,
                       const navvi_files::Cache* cache)
    : config_(with_headroom(config)),
      setting_(config, cache),
      session_(setting_.world, config.sim.life, setting_.course.ends.start,
               static_cast<std::uint64_t>(config.sim.seed)),
      gate_(config.sim.gate),
      navigation_(config.nav, cache),
      guided_(config.feedback, config.person, config.sim.seed, config.speech, spoken) {
  if (config.driver == "sighted")
    sighted_.emplace(config.person.typed().driving, static_cast<std::uint64_t>(config.person.seed),
                     static_cast<std::uint64_t>(config.sim.seed));
  if (!setting_.senses) navigation_.set_map(std::move(setting_.course.voxels));
}

bool ClosedLoop::step() {
  const people::Felt motors = published_.motors;
  published_ = {};
  published_.motors = motors;
  if (!turn_wheels()) return false;
  sense();
  if (session_.due(kNavigationRate) || navigation_.plan_waits()) navigate();
  if (session_.due(kFeedbackRate)) {
    feed_back();
    operate();
  }
  return true;
}

bool ClosedLoop::turn_wheels() {
  const navvi_types::Velocity wheels = gate_.update(instant());
  const bool running = gate_.state() == navvi_safety::CommandGate::State::running;
  return session_.step(wheels, running ? navvi_sim::physics::Braking::normal
                                       : navvi_sim::physics::Braking::emergency) ==
         navvi_sim::live::World::Status::running;
}

void ClosedLoop::sense() {
  const navvi_sim::live::Snapshot& now = session_.world().now();
  published_.odometry = navvi_types::to_msg(session_.world().odometry());
  if (const auto odometry = node::from_msg(published_.odometry)) {
    guided_.take(*odometry, time());
    navigation_.set_velocity(odometry->velocity);
  }
  published_.drive = navvi_types::to_msg(gate_.drive_state(now.stamp()));
  if (const auto gate = node::from_msg(published_.drive)) guided_.take(*gate, time());
  if (session_.due(kLinkRate)) {
    const navvi_types::LinkState link = gate_.link_state(now.stamp());
    navigation_.set_foresight(link.foresight);
    guided_.take(link, time());
    published_.link = navvi_types::to_msg(link);
  }
  for (const navvi_types::Contact& contact : now.contacts) {
    published_.contacts.push_back(navvi_types::to_msg(contact));
    const auto felt = node::from_msg(published_.contacts.back());
    if (felt && !setting_.senses) guided_.take(*felt, time());
  }
  if (session_.due(navvi_sim::live::kProximityRate)) {
    published_.proximity =
        navvi_types::to_msg(session_.world().proximity(config_.sim.detection_radius));
    const auto proximity = node::from_msg(*published_.proximity);
    if (proximity && !setting_.senses) sense_near(*proximity);
    if (proximity) sight_.nearby = proximity->things;
  }
  if (session_.due(navvi_sim::live::kObstaclesRate)) {
    published_.obstacles = navvi_types::to_msg(session_.world().obstacles());
    const auto obstacles = node::from_msg(*published_.obstacles);
    if (obstacles && !setting_.senses) navigation_.set_obstacles(*obstacles, time());
  }
  if (setting_.senses) sense_by_robot();
}

void ClosedLoop::sense_near(const navvi_types::Proximity& proximity) {
  gate_.see(proximity.things, instant());
  guided_.take(proximity, time());
}

void ClosedLoop::sense_by_robot() {
  RobotSenses::News news = setting_.senses->look(session_);
  for (const navvi_types::Contact& contact : news.contacts)
    if (const auto felt = node::from_msg(navvi_types::to_msg(contact))) guided_.take(*felt, time());
  if (news.proximity)
    if (const auto proximity = node::from_msg(navvi_types::to_msg(*news.proximity)))
      sense_near(*proximity);
  perceived_ = std::nullopt;
  if (news.obstacles) perceived_ = node::from_msg(navvi_types::to_msg(*news.obstacles));
  if (perceived_) navigation_.set_obstacles(*perceived_, time());
  if (news.map) navigation_.set_map(std::move(*news.map), "OcTree", setting_.senses->resolution());
}

geometry_msgs::Transform ClosedLoop::pose() const {
  const navvi_sim::live::Snapshot& now = session_.world().now();
  return navvi_sim::node::base_link_msg(
             now.robot.odometry(setting_.world.floor_height, now.stamp()))
      .transform;
}

/// Without a map no goal is ever set, and the trial would have no end.
void ClosedLoop::require_map() const {
  if (navigation_.has_map()) return;
  const std::string& why = navigation_.map_error();
  const bool last = !setting_.senses && !why.empty();
  if (last || time() >= kMapBy)
    throw std::runtime_error("navigation rejects the map of " + config_.sim.world + ": " +
                             (why.empty() ? "none came" : why));
}

void ClosedLoop::navigate() {
  if (!begun_ && navigation_.has_map() && time() >= kGoalAt) {
    begun_ = true;
    navigation_.set_goal(setting_.course.ends.goal);
  }
  const geometry_msgs::Transform at = pose();
  if (const auto robot = node::from_msg(at)) navigation_.set_pose(*robot, at.translation.z, time());
  std::optional<navvi_types::Guidance> guidance = navigation_.update(time());
  require_map();
  if (const auto zone = navigation_.zone(time())) {
    gate_.limit(*zone, instant());
    guided_.take(*zone, time());
  }
  if (!guidance) return;
  guidance->stamp = navvi_types::to_ns(stamp());
  guided_.take(*guidance, time());
  sight_.guidance = *guidance;
  published_.guidance = navvi_types::to_msg(*guidance);
}

void ClosedLoop::feed_back() {
  const geometry_msgs::Transform at = pose();
  const auto command = guided_.feed_back(hand_, at, time());
  if (command)
    gate_.receive({node::from_msg(node::to_msg(command->velocity)), command->lag, ++commands_},
                  instant());
  published_.cues = guided_.played().cues;
  published_.motors = guided_.played().motors;
}

void ClosedLoop::operate() {
  constexpr double kDt = 1.0 / kFeedbackRate;
  hand_ = sighted_ ? sighted_->update(sight_, time(), kDt) : guided_.act(time(), kDt);
}

}  // namespace navvi_people::loop
