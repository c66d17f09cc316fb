// The simulator: a world that lives in step with the wall clock, driven by navvi/command.

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <map>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_safety/command_input.hpp>

#include "live/pacer.hpp"
#include "navvi_sim/live/session.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "node/clock_check.hpp"
#include "node/robot_sensors.hpp"
#include "node/world_outlets.hpp"

namespace navvi_sim::node {
namespace {

constexpr double kTick = 0.005;  // s, wall clock; shorter than a step, for an even pace
constexpr int kMostSteps = 10;   // at once after a delay; beyond it the simulation slows down

class SimNode {
 public:
  SimNode(const setup::SimNodeConfig& config, read::LoadedWorld loaded)
      : config_(config),
        description_(std::move(loaded.world)),
        map_(setup::map_of(config_, description_)),
        gate_(config.gate),
        pacer_(config.life.step, config.rate, kMostSteps) {
    const scenario::StartAndGoal scenario =
        setup::scenario_of(config_, description_, setup::voxels_of(config_, description_));
    session_.emplace(description_, config_.life, scenario.start,
                     static_cast<std::uint64_t>(config_.seed));

    outlets_.emplace(node_, config_, description_, map_, *session_);
    if (config_.sensing != "truth") robot_sensors_.emplace(node_, config_, description_, map_);
    log_world(loaded.notes, scenario);
    outlets_->publish_static(scenario, robot_sensors_
                                           ? robot_sensors_->mounts()
                                           : std::vector<geometry_msgs::TransformStamped>());
    outlets_->publish_drive_state(drive_state());
    outlets_->publish_record();

    ros::NodeHandle commands_node;
    commands_node.setCallbackQueue(&commands_queue_);
    commands_ = commands_node.subscribe("navvi/command", navvi_safety::kCommandQueue,
                                        &SimNode::receive, this, navvi_safety::command_transport());
    if (config_.gate.assistance != "off")
      near_ = navvi_safety::see_by(
          commands_node, config_.sensing == "truth" ? "navvi/proximity" : "navvi/seen/proximity",
          gate_, [this] { return instant(); });
    zones_ = navvi_safety::limit_by(commands_node, gate_, [this] { return instant(); });
    clocks_ = commands_node.subscribe("clock", 100, &SimNode::hear_clock, this,
                                      ros::TransportHints().tcpNoDelay());
    timer_ = node_.createWallTimer(ros::WallDuration(kTick), &SimNode::tick, this);
  }

  /// The exit code of the process.
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  void log_world(const std::vector<std::string>& notes,
                 const scenario::StartAndGoal& scenario) const {
    for (const std::string& note : notes) ROS_WARN("%s", note.c_str());
    if (!scenario.note.empty()) ROS_WARN("%s", scenario.note.c_str());
    std::map<std::string, int> standing, moving;
    for (const Thing& thing : description_.things)
      ++(thing.route ? moving : standing)[to_string(thing.thing_class)];
    ROS_INFO("world %s, floor at z = %.3f m", description_.name.c_str(), description_.floor_height);
    for (const auto& [thing_class, count] : standing)
      ROS_INFO("  %4d %s standing", count, thing_class.c_str());
    for (const auto& [thing_class, count] : moving)
      ROS_INFO("  %4d %s on routes", count, thing_class.c_str());
    if (robot_sensors_)
      ROS_INFO(
          "sensing %s: the guide gets scans, %s and odometry; map -> odom is the simulator's, as "
          "if a localizer erred nowhere",
          config_.sensing.c_str(), config_.sensing == "robot" ? "clouds" : "no clouds");
    ROS_INFO("start %.2f, %.2f heading %.2f rad; goal %.2f, %.2f", scenario.start.position.x(),
             scenario.start.position.y(), scenario.start.yaw, scenario.goal.x(), scenario.goal.y());
  }

  void receive(const ros::MessageEvent<const geometry_msgs::TwistStamped>& command) {
    input_.receive(command, instant());
  }

  /// The world has one clock, its own. With another one, nothing that the guide says can be relied
  /// on.
  void hear_clock(const ros::MessageEvent<const rosgraph_msgs::Clock>& clock) {
    const double stamp = clock.getConstMessage()->clock.toSec(), now = world().now().time;
    if (!is_another_clock(clock.getPublisherName(), ros::this_node::getName(), stamp, now)) return;
    gate_.stop(navvi_safety::CommandGate::Reason::clock_jumped);
    ROS_WARN_THROTTLE(5.0, "clock: %s publishes another time, by %.1f s; the wheels stand",
                      clock.getPublisherName().c_str(), stamp - now);
  }

  void tick(const ros::WallTimerEvent&) {
    const double wall = ros::SteadyTime::now().toSec();
    const int due = pacer_.due(wall);
    const long dropped = pacer_.dropped();
    for (int i = 0; i < due; ++i) {
      // Commands that came while this process was held up count before their age does. The first of
      // them finds the gate stopped if they came too late.
      commands_queue_.callAvailable();
      if (config_.rate > 1.0 && gate_.outrun(instant())) return;
      if (!step()) return;
    }
    if (due == kMostSteps && dropped > 0)
      ROS_WARN_THROTTLE(5.0, "the simulation is slower than requested: %ld steps skipped so far",
                        dropped);
  }

  [[nodiscard]] bool step() {
    const navvi_types::Velocity wheels = gate_.update(instant());
    const bool running = gate_.state() == navvi_safety::CommandGate::State::running;
    const live::World::Status status =
        session_->step(wheels, running ? physics::Braking::normal : physics::Braking::emergency);
    if (status != live::World::Status::running) {
      ROS_FATAL("the simulation has stopped at %.2f s: a number in it is not finite",
                world().now().time);
      exit_code_ = 3;
      timer_.stop();
      navvi_config::end();
      return false;
    }
    outlets_->publish_state();
    if (robot_sensors_) robot_sensors_->publish(*session_);
    outlets_->publish_drive_state(drive_state());
    link_.publish(gate_, instant().wall, world().now().stamp());
    outlets_->publish_record();
    return true;
  }

  [[nodiscard]] navvi_types::DriveState drive_state() const {
    return gate_.drive_state(world().now().stamp());
  }
  [[nodiscard]] const live::World& world() const { return session_->world(); }
  /// Simulated time comes from the world itself, not from a clock that lags behind it.
  [[nodiscard]] navvi_safety::Instant instant() const {
    return {ros::SteadyTime::now().toSec(), world().now().time};
  }

  ros::NodeHandle node_;
  ros::CallbackQueue commands_queue_;
  setup::SimNodeConfig config_;
  WorldDescription description_;
  occupancy::OccupancyMap map_;
  std::optional<live::Session> session_;
  std::optional<WorldOutlets> outlets_;
  std::optional<RobotSensors> robot_sensors_;
  navvi_safety::CommandGate gate_;
  navvi_safety::CommandInput input_{gate_, config_.rate};
  navvi_safety::LinkOutlet link_{node_};
  live::Pacer pacer_;
  int exit_code_ = 0;
  ros::Subscriber commands_, near_, zones_, clocks_;
  ros::WallTimer timer_;
};

/// \throws ConfigError with a sentence on the world that was chosen
int run(const setup::SimNodeConfig& config) try {
  read::LoadedWorld loaded = setup::load_world(config);
  const SimNode sim(config, std::move(loaded));
  navvi_config::spin();
  return sim.exit_code();
} catch (const WorldError& error) {
  throw navvi_config::ConfigError(error.what());
}

}  // namespace
}  // namespace navvi_sim::node

int main(int argc, char** argv) {
  using navvi_sim::setup::SimNodeConfig;
  if (const auto code = navvi_config::print_parameters<SimNodeConfig>(argc, argv)) return *code;
  navvi_config::ask_for_priority(-10);
  navvi_config::init(argc, argv, "sim_node");
  return navvi_config::run_node<SimNodeConfig>(navvi_sim::node::run);
}
