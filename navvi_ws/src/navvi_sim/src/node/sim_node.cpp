// The simulator: a world that lives in step with the wall clock, driven by cmd_vel.

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_msgs/Bool.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <navvi_config/priority.hpp>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_safety/command_input.hpp>
#include <navvi_types/msg_conversion.hpp>

#include "live/pacer.hpp"
#include "navvi_sim/description/world_hash.hpp"
#include "navvi_sim/live/session.hpp"
#include "navvi_sim/node/msg_conversion.hpp"
#include "navvi_sim/scene/scene.hpp"
#include "navvi_sim/setup/sim_node_config.hpp"
#include "node/sensor_conversion.hpp"
#include "read/thing_table.hpp"

namespace navvi_sim::node {
namespace {

constexpr double kTick = 0.005;  // s, wall clock; shorter than a step, for an even pace
// What moves in the picture, for a bag that RViz shows without us: seldom, that it stays small.
constexpr int kMostSteps = 10;  // at once after a delay; beyond it the simulation slows down
constexpr double kRecordedPeriod = 0.5;     // s
constexpr double kRecordedMarkers = 400.0;  // a second, at most
constexpr double kJump = 0.25;              // s, of ROS time; longer than any step
constexpr const char* kLidarFrame = "laser";
constexpr const char* kCameraFrame = "camera_link";

/// The sensors of the robot and its bumper, where there are any: what they publish is all that a
/// robot knows of the world.
class RobotSensors {
 public:
  RobotSensors(ros::NodeHandle& node, const setup::SimNodeConfig& config,
               const WorldDescription& world, const occupancy::OccupancyMap& map)
      : columns_(config.camera.columns), sensors_(world) {
    const auto seed = static_cast<std::uint64_t>(config.seed);
    lidar_.emplace(config.lidar, seed);
    scan_ = node.advertise<sensor_msgs::LaserScan>("scan", 5);
    if (config.sensing == "robot") {
      camera_.emplace(config.camera, ~seed);
      points_ = node.advertise<sensor_msgs::PointCloud2>("points", 5);
    }
    bumper_ = node.advertise<std_msgs::Bool>("bumper", 10, true);
    prior_ = node.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    prior_.publish(to_msg(occupancy::slice_of(map, world.floor_height, config.lidar.height),
                          world.floor_height));
  }

  [[nodiscard]] std::vector<geometry_msgs::TransformStamped> mounts() const {
    std::vector<geometry_msgs::TransformStamped> frames{mount_msg(*lidar_, kLidarFrame)};
    if (camera_) frames.push_back(mount_msg(*camera_, kCameraFrame));
    return frames;
  }

  void publish(const live::Session& session) {
    const live::Snapshot& now = session.world().now();
    if (session.due(lidar_->rate()))
      scan_.publish(scan_msg(*lidar_, sensors_.look(*lidar_, now), kLidarFrame));
    if (camera_ && session.due(camera_->rate()))
      points_.publish(cloud_msg(*camera_, sensors_.look(*camera_, now), columns_, kCameraFrame));
    // A pulse a contact.
    std_msgs::Bool bumped;
    bumped.data = !now.contacts.empty();
    if (bumped.data != bumped_) bumper_.publish(bumped);
    bumped_ = bumped.data;
  }

 private:
  int columns_;
  sensors::Sensors sensors_;
  std::optional<sensors::Sensor> lidar_, camera_;
  ros::Publisher scan_, points_, bumper_, prior_;
  bool bumped_ = false;
};

class SimNode {
 public:
  SimNode(const setup::SimNodeConfig& config, read::LoadedWorld loaded);

  /// The exit code of the process.
  [[nodiscard]] int exit_code() const { return exit_code_; }

 private:
  void advertise();
  void publish_static(const scenario::StartAndGoal& scenario);
  void log_world(const std::vector<std::string>& notes,
                 const scenario::StartAndGoal& scenario) const;
  void receive(const ros::MessageEvent<const geometry_msgs::Twist>& command);
  void hear_clock(const ros::MessageEvent<const rosgraph_msgs::Clock>& clock);
  void tick(const ros::WallTimerEvent& event);
  [[nodiscard]] bool step();
  void publish_state();
  void publish_drive_state();
  void publish_record();
  [[nodiscard]] const live::World& world() const { return session_->world(); }
  [[nodiscard]] ros::Time stamp() const { return ros::Time(world().now().time); }
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
  std::optional<RobotSensors> robot_sensors_;
  scene::Scene looks_;
  navvi_safety::CommandGate gate_;
  navvi_safety::CommandInput input_{gate_};
  live::Pacer pacer_;
  std::size_t commands_published_ = 0;
  std::size_t hashes_published_ = 0;
  int exit_code_ = 0;
  std::optional<navvi_types::DriveState> drive_state_;

  double next_recorded_ = 0.0;  ///< s, of the simulation

  ros::Publisher clock_, odom_, octomap_, cells_, scene_, moving_, recorded_, obstacles_,
      proximity_, contacts_, scenario_, drive_, applied_, hash_;
  tf2_ros::TransformBroadcaster transforms_;
  tf2_ros::StaticTransformBroadcaster static_transforms_;
  ros::Subscriber commands_, clocks_;
  ros::WallTimer timer_;
};

SimNode::SimNode(const setup::SimNodeConfig& config, read::LoadedWorld loaded)
    : config_(config),
      description_(std::move(loaded.world)),
      map_(setup::map_of(config_, description_)),
      looks_(description_, config.life.robot),
      gate_(config.gate),
      pacer_(config.life.step, config.rate, kMostSteps) {
  const scenario::StartAndGoal scenario = setup::scenario_of(config_, description_, map_);
  session_.emplace(description_, config_.life, scenario.start,
                   static_cast<std::uint64_t>(config_.seed));

  advertise();
  if (config_.sensing != "truth") robot_sensors_.emplace(node_, config_, description_, map_);
  log_world(loaded.notes, scenario);
  publish_static(scenario);
  publish_drive_state();
  publish_record();

  ros::NodeHandle commands_node;
  commands_node.setCallbackQueue(&commands_queue_);
  commands_ = commands_node.subscribe("cmd_vel", navvi_safety::kCommandQueue, &SimNode::receive,
                                      this, ros::TransportHints().tcpNoDelay());
  clocks_ = commands_node.subscribe("clock", 100, &SimNode::hear_clock, this,
                                    ros::TransportHints().tcpNoDelay());
  timer_ = node_.createWallTimer(ros::WallDuration(kTick), &SimNode::tick, this);
}

void SimNode::advertise() {
  clock_ = node_.advertise<rosgraph_msgs::Clock>("clock", 10);
  odom_ = node_.advertise<nav_msgs::Odometry>("odom", 10);
  octomap_ = node_.advertise<octomap_msgs::Octomap>("octomap_binary", 1, true);
  // Large and seldom looked at: made for each subscriber.
  cells_ = node_.advertise<visualization_msgs::MarkerArray>(
      "occupied_cells_vis_array", 1, [this](const ros::SingleSubscriberPublisher& listener) {
        listener.publish(occupied_cells_msg(map_, stamp()));
      });
  scene_ = node_.advertise<visualization_msgs::MarkerArray>("navvi/scene", 1, true);
  moving_ = node_.advertise<visualization_msgs::MarkerArray>("navvi/scene_moving", 1);
  recorded_ = node_.advertise<visualization_msgs::MarkerArray>("navvi/scene_recorded", 1);
  obstacles_ = node_.advertise<navvi_msgs::Obstacles>("navvi/obstacles", 2);
  proximity_ = node_.advertise<navvi_msgs::Proximity>("navvi/proximity", 2);
  contacts_ = node_.advertise<navvi_msgs::Contact>("navvi/contacts", 100);
  scenario_ = node_.advertise<navvi_msgs::Scenario>("navvi/scenario", 1, true);
  drive_ = node_.advertise<navvi_msgs::DriveState>("navvi/drive_state", 1, true);
  // A subscriber that comes in mid-session can still repeat it from its first step.
  applied_ = node_.advertise<navvi_msgs::AppliedCommands>(
      "navvi/applied_commands", 1000, [this](const ros::SingleSubscriberPublisher& listener) {
        listener.publish(applied_commands_msg(session_->commands(), 0, stamp()));
      });
  hash_ = node_.advertise<navvi_msgs::StateHash>("navvi/state_hash", 1, true);
}

void SimNode::publish_static(const scenario::StartAndGoal& scenario) {
  if (!config_.life.robot.imperfections.odometry_drifts())
    static_transforms_.sendTransform(odom_msg(world().now()));
  if (robot_sensors_) static_transforms_.sendTransform(robot_sensors_->mounts());
  octomap_.publish(to_msg(
      config_.octomap.free ? occupancy::with_free_space(map_, description_) : map_, ros::Time()));
  scene_.publish(looks_.standing(stamp()));
  scenario_.publish(navvi_types::to_msg(navvi_types::Scenario{
      description_.name, world_hash(description_), static_cast<std::uint64_t>(config_.seed),
      scenario.goal, scenario.start, description_.floor_height,
      scenario::free_places_of(description_, map_, config_.scenario),
      setup::recipe(config_, scenario), world().now().stamp()}));
}

void SimNode::log_world(const std::vector<std::string>& notes,
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

void SimNode::receive(const ros::MessageEvent<const geometry_msgs::Twist>& command) {
  input_.receive(command, instant());
}

/// The world has one clock, its own. With another one, nothing that the guide says can be relied
/// on.
void SimNode::hear_clock(const ros::MessageEvent<const rosgraph_msgs::Clock>& clock) {
  const double jump = clock.getConstMessage()->clock.toSec() - world().now().time;
  if (std::abs(jump) <= kJump) return;
  gate_.stop(navvi_safety::CommandGate::Reason::clock_jumped);
  ROS_WARN_THROTTLE(5.0, "clock: %s publishes another time, by %.1f s; the wheels stand",
                    clock.getPublisherName().c_str(), jump);
}

void SimNode::tick(const ros::WallTimerEvent&) {
  const double wall = ros::SteadyTime::now().toSec();
  const int due = pacer_.due(wall);
  const long dropped = pacer_.dropped();
  for (int i = 0; i < due; ++i) {
    // Commands that came while this process was held up count before their age does. The first of
    // them finds the gate stopped if they came too late.
    commands_queue_.callAvailable();
    if (!step()) return;
  }
  if (due == kMostSteps && dropped > 0)
    ROS_WARN_THROTTLE(5.0, "the simulation is slower than asked for: %ld steps let go so far",
                      dropped);
}

bool SimNode::step() {
  const navvi_types::Velocity wheels = gate_.update(instant());
  const bool running = gate_.state() == navvi_safety::CommandGate::State::running;
  const live::World::Status status =
      session_->step(wheels, running ? physics::Braking::normal : physics::Braking::emergency);
  if (status != live::World::Status::running) {
    ROS_FATAL("the simulation has stopped at %.2f s: a number in it is not finite",
              world().now().time);
    exit_code_ = 3;
    timer_.stop();
    ros::requestShutdown();
    return false;
  }
  publish_state();
  if (robot_sensors_) robot_sensors_->publish(*session_);
  publish_drive_state();
  publish_record();
  return true;
}

void SimNode::publish_state() {
  const live::Snapshot& now = world().now();
  rosgraph_msgs::Clock clock;
  clock.clock = stamp();
  clock_.publish(clock);
  const navvi_types::Odometry odometry = world().odometry();
  std::vector<geometry_msgs::TransformStamped> frames{base_link_msg(odometry)};
  if (config_.life.robot.imperfections.odometry_drifts()) frames.push_back(odom_msg(now));
  transforms_.sendTransform(frames);
  odom_.publish(navvi_types::to_msg(odometry));
  for (const navvi_types::Contact& contact : now.contacts)
    contacts_.publish(navvi_types::to_msg(contact));
  if (session_->due(live::kProximityRate))
    proximity_.publish(navvi_types::to_msg(world().proximity(config_.detection_radius)));
  if (session_->due(live::kObstaclesRate)) {
    obstacles_.publish(navvi_types::to_msg(world().obstacles()));
    const visualization_msgs::MarkerArray& scene = looks_.moving(now, stamp());
    moving_.publish(scene);
    if (now.time >= next_recorded_) {
      recorded_.publish(scene);
      const auto markers = static_cast<double>(scene.markers.size());
      next_recorded_ = now.time + std::max(kRecordedPeriod, markers / kRecordedMarkers);
    }
  }
}

void SimNode::publish_drive_state() {
  const navvi_types::DriveState now = gate_.drive_state(world().now().stamp());
  if (drive_state_ && drive_state_->state == now.state && drive_state_->reason == now.reason &&
      drive_state_->rejected == now.rejected && drive_state_->intruder == now.intruder)
    return;
  drive_.publish(navvi_types::to_msg(now));
  drive_state_ = now;
}

/// What repeats this world, and what proves that the repetition is the same.
void SimNode::publish_record() {
  if (commands_published_ < session_->commands().size()) {
    applied_.publish(applied_commands_msg(session_->commands(), commands_published_, stamp()));
    commands_published_ = session_->commands().size();
  }
  if (hashes_published_ < session_->hashes().size()) {
    hash_.publish(navvi_types::to_msg(session_->hashes().back()));
    hashes_published_ = session_->hashes().size();
  }
}

/// \throws ConfigError with a sentence on the world that was chosen
int run(const setup::SimNodeConfig& config) try {
  read::LoadedWorld loaded = setup::load_world(config);
  if (!loaded.rules.empty())
    ROS_INFO("what the models of the world are:\n%s", read::thing_table(loaded, 100).c_str());
  const SimNode sim(config, std::move(loaded));
  ros::spin();
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
  ros::init(argc, argv, "sim_node");
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  return navvi_config::run_node<SimNodeConfig>(navvi_sim::node::run);
}
