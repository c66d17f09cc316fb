#include "navvi_people/loop/closed_loop.hpp"

#include <navvi_config/reader.hpp>
#include <navvi_feedback/node/msg_conversion.hpp>
#include <navvi_sim/node/msg_conversion.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/voice_model.hpp>
#include <utility>

#include "node/msg_conversion.hpp"

namespace navvi_people::loop {
namespace {

constexpr double kNavigationRate = 20.0;  // Hz, of nav_node's timer and of the obstacles
constexpr double kFeedbackRate = 50.0;    // Hz, of feedback_node's and operator_node's
constexpr double kGoalAt = 1.0;           // s; trial_node sets the goal when every part is there
// espeak-ng at 220 words a minute, measured over NavVI's phrases.

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
        "sighted: the person's hand and liking of speed, but led by eyes: the reference");
}

ClosedLoop::Setting::Setting(const ClosedLoopConfig& config)
    : world(navvi_sim::setup::load_world(config.sim).world) {
  const navvi_sim::occupancy::OccupancyMap occupancy = navvi_sim::setup::map_of(config.sim, world);
  scenario = navvi_sim::setup::scenario_of(config.sim, world, occupancy);
  if (config.sim.sensing == "truth")
    map = navvi_sim::node::to_msg(occupancy, ros::Time());
  else
    senses.emplace(config.sim, config.perception, world, occupancy);
}

ClosedLoop::ClosedLoop(const ClosedLoopConfig& config, const std::string& phrases)
    : config_(config),
      setting_(config),
      session_(setting_.world, config.sim.life, setting_.scenario.start,
               static_cast<std::uint64_t>(config.sim.seed)),
      gate_(config.sim.gate),
      navigation_(config.nav),
      guide_(config.feedback, phrases),
      person_(config.person, phrases) {
  if (config.driver == "sighted")
    sighted_.emplace(config.person.driving, static_cast<std::uint64_t>(config.person.seed));
  if (!setting_.senses)
    navigation_.set_map(std::move(setting_.map.data), setting_.map.id, setting_.map.resolution);
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
  using navvi_safety::CommandGate;
  const navvi_types::Velocity wheels = gate_.update(instant());
  const bool running = gate_.state() == CommandGate::State::running;
  return session_.step(wheels, running ? navvi_sim::physics::Braking::normal
                                       : navvi_sim::physics::Braking::emergency) ==
         navvi_sim::live::World::Status::running;
}

void ClosedLoop::sense() {
  const navvi_sim::live::Snapshot& now = session_.world().now();
  published_.odometry = navvi_types::to_msg(session_.world().odometry());
  if (const auto odometry = node::from_msg(published_.odometry)) {
    guide_.take(*odometry, time());
    navigation_.set_speed(odometry->velocity.linear);
  }
  if (const auto gate = node::from_msg(navvi_types::to_msg(gate_.drive_state(now.stamp()))))
    guide_.take(*gate, time());
  for (const navvi_types::Contact& contact : now.contacts) {
    published_.contacts.push_back(navvi_types::to_msg(contact));
    const auto felt = node::from_msg(published_.contacts.back());
    if (felt && !setting_.senses) guide_.take(*felt);
  }
  if (session_.due(navvi_sim::live::kProximityRate)) {
    published_.proximity =
        navvi_types::to_msg(session_.world().proximity(config_.sim.detection_radius));
    const auto proximity = node::from_msg(*published_.proximity);
    if (proximity && !setting_.senses) guide_.take(*proximity, time());
    if (proximity) sight_.nearby = proximity->things;
  }
  if (session_.due(navvi_sim::live::kObstaclesRate)) {
    published_.obstacles = navvi_types::to_msg(session_.world().obstacles());
    const auto obstacles = node::from_msg(*published_.obstacles);
    if (obstacles && !setting_.senses) navigation_.set_obstacles(*obstacles, time());
  }
  if (setting_.senses) sense_by_robot();
}

void ClosedLoop::sense_by_robot() {
  RobotSenses::News news = setting_.senses->look(session_);
  for (const navvi_types::Contact& contact : news.contacts)
    if (const auto felt = node::from_msg(navvi_types::to_msg(contact))) guide_.take(*felt);
  if (news.proximity)
    if (const auto proximity = node::from_msg(navvi_types::to_msg(*news.proximity)))
      guide_.take(*proximity, time());
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

void ClosedLoop::navigate() {
  if (!begun_ && navigation_.has_map() && time() >= kGoalAt) {
    begun_ = true;
    navigation_.set_goal(setting_.scenario.goal);
  }
  const geometry_msgs::Transform at = pose();
  if (const auto robot = node::from_msg(at)) navigation_.set_pose(*robot, at.translation.z, time());
  std::optional<navvi_types::Guidance> guidance = navigation_.update(time());
  if (!guidance) return;
  guidance->stamp = navvi_types::to_ns(stamp());
  guide_.take(*guidance, time());
  sight_.guidance = *guidance;
  published_.guidance = navvi_types::to_msg(*guidance);
}

void ClosedLoop::feed_back() {
  navvi_feedback::senses::Devices devices;
  if (const auto hands = navvi_feedback::node::from_msg(node::to_msg(hand_, stamp())))
    devices.hands = *hands;
  devices.speaking = time() < speaks_until_;
  devices.words = config_.speech;
  const bool heard = config_.speech || config_.feedback.has_sounds();
  devices.audio = heard ? navvi_feedback::senses::Link::alive : navvi_feedback::senses::Link::never;
  devices.robot = node::from_msg(pose());
  const auto told = guide_.update(devices, time());
  if (!told) return;
  if (told->command) gate_.receive(node::from_msg(node::to_msg(*told->command)), instant());
  published_.motors = {told->rumble.left, told->rumble.right};
  if (told->rumble_due) person_.feel(published_.motors, time());
  if (told->voice.stop) speaks_until_ = time();
  if (told->voice.start) speaks_until_ = navvi_types::spoken_at(time(), told->voice.start->size());
  std::vector<CueEvent> events = told->said;
  for (const navvi_feedback::sounds::Play& play : told->plays)
    events.push_back(guide_.event_of(play));
  for (CueEvent& event : events) {
    event.stamp = navvi_types::to_ns(stamp());
    published_.cues.push_back(node::to_msg(event));
  }
}

void ClosedLoop::operate() {
  for (const navvi_msgs::Cue& cue : published_.cues)
    if (const auto event = node::from_msg(cue))
      if (const auto heard = people::heard(*event)) person_.hear(*heard, time());
  hand_ = sighted_ ? sighted_->update(sight_, time(), 1.0 / kFeedbackRate)
                   : person_.update(time(), 1.0 / kFeedbackRate);
}

}  // namespace navvi_people::loop
