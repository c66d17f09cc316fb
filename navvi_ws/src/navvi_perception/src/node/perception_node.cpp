// Scans, clouds, a bumper and transforms in; OctoMap, obstacles, proximity and contacts out.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <laser_geometry/laser_geometry.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

#include <boost/algorithm/string.hpp>
#include <cmath>
#include <memory>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>
#include <navvi_types/transform_listener.hpp>
#include <utility>

#include "navvi_perception/see/perception.hpp"
#include "node/msg_conversion.hpp"
#include "node/sensor_queue.hpp"

namespace navvi_perception::node {
namespace {

using sensor_msgs::LaserScan;
using sensor_msgs::PointCloud2;

constexpr double kRate = 20.0;           // Hz, of proximity
constexpr double kReport = 1.0;          // s, between two diagnostics
constexpr int kBegins = 10;              // of these, in which sensing may begin
constexpr double kFresh = 0.5;           // s without a sight, after which nothing is known
// s, and a period of clouds, likewise for each sensor: at 5 Hz it may miss three times, and what it
// tracks is told (TrackConfig::kTold) until then
constexpr double kSilent = 0.7;

struct NodeConfig {
  see::PerceptionConfig core;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::string odom_frame = "odom";
  std::string scans = "scan", clouds = "points";  ///< topics, separated by commas
  std::string no_return = "unknown";             ///< or free
  std::string prior;         ///< a file with an OctoMap; empty: the topic map is listened to
  std::string bumper;        ///< empty: none
  double cloud_rate = 10.0;  ///< Hz
  int cloud_points = 20000;  ///< of a cloud that are used at most, evenly spread

  void describe(navvi_config::Visitor& visit) {
    using namespace navvi_config;
    core.describe(visit);
    visit(map_frame, "map_frame", Any{}, "", "frame of the map and of all that is published");
    visit(base_frame, "base_frame", Any{}, "", "frame of the robot");
    visit(odom_frame, "odom_frame", Any{}, "",
          "frame of odometry, which a localizer places in the map");
    visit(scans, "scans", Any{}, "", "topics with sensor_msgs/LaserScan, separated by commas");
    visit(clouds, "clouds", Any{}, "", "topics with sensor_msgs/PointCloud2, separated by commas");
    visit(no_return, "no_return", navvi_config::OneOf{{"unknown", "free"}}, "",
          "what the drivers mean by a ray of 0, NaN, or range_max and more, and by a cloud without "
          "points: no measurement, or nothing there (doc/robot.md has a table of drivers)");
    visit(
        prior, "prior", Any{}, "",
        "file .bt or .ot with the OctoMap of what stands for good, used in place of the topic map");
    visit(bumper, "bumper", Any{}, "",
          "topic with std_msgs/Bool, true while something is touched; empty: contacts are unknown");
    visit(cloud_rate, "cloud_rate", Range{3.0, 100.0}, "Hz", "clouds that come faster are skipped");
  }
};

class PerceptionNode {
 public:
  PerceptionNode(ros::NodeHandle node, const NodeConfig& config)
      : config_(config), perception_(std::make_unique<see::Perception>(config.core)) {
    map_ = node.advertise<octomap_msgs::Octomap>("octomap_binary", 1, true);
    obstacles_ = node.advertise<navvi_msgs::Obstacles>("navvi/obstacles", 2);
    seen_ = node.advertise<visualization_msgs::MarkerArray>("navvi/seen_markers", 1);
    proximity_ = node.advertise<navvi_msgs::Proximity>("navvi/proximity", 2);
    diagnostics_ = node.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 10);
    listen<LaserScan>(node, config.scans, NodeConfig().scans);
    listen<PointCloud2>(node, config.clouds, NodeConfig().clouds);
    moved_ = buffer_._addTransformsChangedListener([this] { serve(); });
    if (config.prior.empty())
      subscribers_.push_back(navvi_types::subscribe<nav_msgs::OccupancyGrid>(
          node, "map", 1, from_msg, [this](const sight::Prior& prior) { know(prior); },
          config.map_frame, [this](const std::string& why) { count("map", why); }));
    else
      know(config.core.prior_of(config.prior));
    if (!config.bumper.empty())
      bumper_ = node.subscribe(config.bumper, 10, &PerceptionNode::on_bumper, this);
    timer_ = node.createWallTimer(ros::WallDuration(1.0 / kRate),
                                  [this](const ros::WallTimerEvent&) { tell_what_is_near(); });
    report_timer_ = node.createWallTimer(ros::WallDuration(kReport),
                                         [this](const ros::WallTimerEvent&) { report(); });
    ROS_INFO(
        "Every object is called other, or wall if it stands and is long; what lies outside the "
        "sensors' sight is not known, so %s. Contacts: %s.",
        "a lidar alone misses what ends below its plane and what hangs above it",
        config.bumper.empty() ? "unknown, as there is no bumper" : config.bumper.c_str());
  }

  ~PerceptionNode() { moved_.disconnect(); }

 private:
  struct Sensor {
    std::string topic;
    SensorQueue queue;
    std::int64_t last = 0;   ///< ns, its last stamp
    ros::Time taken = {};    ///< when its last sight was; 0: none yet, and none need come
    std::string refused = {};  ///< why its last message was, if it was
    bool sees_body = false;  ///< its own robot, which was logged
  };

  template <typename Message>
  void listen(ros::NodeHandle& node, const std::string& topics, const std::string& usual) {
    std::vector<std::string> names;
    boost::split(names, topics, boost::is_any_of(", "), boost::token_compress_on);
    for (const std::string& topic : names) {
      if (topic.empty()) continue;
      const std::size_t sensor = sensors_.size();
      sensors_.push_back({topic, SensorQueue(buffer_, config_.map_frame, config_.base_frame)});
      // Somebody has named it: a lone one on the usual topic need not be there.
      if (names.size() > 1 || navvi_types::without_slash(topic) != usual)
        sensors_.back().taken = ros::TIME_MIN;
      subscribers_.push_back(navvi_types::subscribe<Message>(
          node, topic, SensorQueue::kMost, from_msg,
          [this, sensor](const typename Message::ConstPtr& msg) { receive(sensor, msg); }, {},
          [this, sensor](const std::string& why) {
            sensors_[sensor].refused = why;
            count(sensors_[sensor].topic, why);
          }));
    }
  }

  void receive(std::size_t sensor, const LaserScan::ConstPtr& scan) {
    wait(sensor, {scan->header, sweep_of(*scan), ros::Time::now(), scan, nullptr});
  }
  void receive(std::size_t sensor, const PointCloud2::ConstPtr& cloud) {
    const auto last = navvi_types::from_ns(sensors_[sensor].last);
    const double since = (cloud->header.stamp - last).toSec();
    if (since < 0.0 || since * config_.cloud_rate >= 1.0)
      wait(sensor, {cloud->header, 0.0, ros::Time::now(), nullptr, cloud});
  }

  void wait(std::size_t sensor, Waiting one) {
    const std::string why = sensors_[sensor].queue.push(std::move(one));
    if (!why.empty()) refuse(sensor, why);
    serve();
  }

  /// Takes what need not wait any more, in the order of each sensor.
  void serve() {
    for (std::size_t sensor = 0; sensor < sensors_.size(); ++sensor)
      while (const auto next = sensors_[sensor].queue.next(ros::Time::now())) {
        sight::Sight sight;
        const Waiting& one = next->one;
        if (!next->why.empty())
          refuse(sensor, next->why);
        else if (begin(one.header, sensor, sight) &&
                 (one.scan ? read(*one.scan, next->whole, sight) : read(*one.cloud, sight)))
          take(sight);
      }
  }

  /// \param whole  the sensor's place is known for all of the sweep
  bool read(const LaserScan& scan, bool whole, sight::Sight& sight) {
    LaserScan rays = plain(scan, config_.no_return == "free");
    rays.header.frame_id = navvi_types::without_slash(scan.header.frame_id);
    if (!whole) rays.time_increment = 0.0F;
    PointCloud2 cloud;
    try {
      projector_.transformLaserScanToPointCloud(config_.map_frame, with_clear_rays(rays), cloud,
                                                buffer_, static_cast<double>(scan.range_max),
                                                laser_geometry::channel_option::Index);
    } catch (const tf2::TransformException& error) {
      refuse(sight.sensor, error.what());
      return false;
    }
    add_points(rays, cloud, sight);
    if (sight.hits.empty() && sight.clear.empty()) {
      refuse(sight.sensor,
             "none of its rays has a measurement (all are 0, NaN, or range_max and more); where "
             "the driver means by this that nothing is near, set perception/no_return to free");
      return false;
    }
    return true;
  }

  bool read(const PointCloud2& cloud, sight::Sight& sight) {
    const std::optional<Eigen::Isometry3d> pose =
        in_map(navvi_types::without_slash(cloud.header.frame_id), cloud.header.stamp);
    if (!pose) return false;
    sight.in_plane = false;
    sight.hits = points_of(cloud, static_cast<std::size_t>(config_.cloud_points));
    for (Eigen::Vector3d& hit : sight.hits) hit = *pose * hit;
    if (!sight.hits.empty() || config_.no_return == "free") return true;
    refuse(sight.sensor,
           "it has no finite point; where the driver means by this that nothing is near, set "
           "perception/no_return to free");
    return false;
  }

  /// \return whether it is the first of its kind
  bool count(const std::string& topic, const std::string& why) {
    last_refusal_ = topic + ": " + why;
    refused_ = true;
    return refusals_(last_refusal_);
  }

  void refuse(std::size_t sensor, const std::string& why) {
    sensors_[sensor].refused = why;
    if (count(sensors_[sensor].topic, why))
      ROS_WARN("A message on %s was dropped: %s. More of this kind are dropped unsaid.",
               sensors_[sensor].topic.c_str(), why.c_str());
  }

  void know(const sight::Prior& prior) {
    if (prior == prior_) return;
    ROS_INFO_ONCE("A prior map of %d x %d cells is known. Later maps are taken unsaid.",
                  prior.width, prior.height);
    prior_ = prior;
    perception_->know(prior_);
  }

  /// Fills in all but the points. \return false if it cannot be used
  bool begin(const std_msgs::Header& header, std::size_t sensor, sight::Sight& sight) {
    (void)robot_now();  // a transform from the future would bend those before it
    const auto eye = in_map(header.frame_id, header.stamp);
    const auto robot = in_map(config_.base_frame, header.stamp);
    if (!eye || !robot) {
      sensors_[sensor].refused = last_refusal_;
      return false;
    }
    sight.stamp = navvi_types::to_ns(header.stamp);
    std::int64_t& last = sensors_[sensor].last;
    if ((navvi_types::from_ns(last) - header.stamp).toSec() > SensorQueue::kOld) {
      ROS_WARN("Time jumped back; what was seen is forgotten.");
      perception_ = std::make_unique<see::Perception>(config_.core, prior_);
      for (Sensor& one : sensors_) {
        one.last = 0;
        if (!one.taken.isZero()) one.taken = ros::TIME_MIN;  // each that has to must go on
      }
    } else if (sight.stamp < last) {
      refuse(sensor, "a later one came before it");
      return false;
    }
    last = sight.stamp;
    sight.sensor = sensor;
    sight.robot = flat(*robot);
    sight.origin = eye->translation();
    return true;
  }

  static navvi_types::Pose2 flat(const Eigen::Isometry3d& pose) {
    const Eigen::Vector3d ahead = pose.linear().col(0);
    return {pose.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
  }

  std::optional<Eigen::Isometry3d> in_map(const std::string& frame, const ros::Time& time) {
    try {
      return pose_of(buffer_.lookupTransform(config_.map_frame, frame, time).transform);
    } catch (const tf2::TransformException& error) {
      count(frame, error.what());
      return std::nullopt;
    }
  }

  std::optional<navvi_types::Pose2> robot_now() {
    const auto found =
        navvi_types::newest(buffer_, config_.map_frame, config_.base_frame, ros::Time::now());
    const auto pose = found ? pose_of(found->transform) : std::nullopt;
    if (!pose) return std::nullopt;
    return robot_ = flat(*pose);
  }

  void take(const sight::Sight& sight) {
    if (!perception_->believes(sight))
      return refuse(sight.sensor,
                    "no ray returns, though the map has a wall within range: the sensor is blind, "
                    "or the robot is elsewhere");
    note_body(sight);
    perception_->take(sight);
    sight_ = sight.stamp;
    taken_ = sensors_[sight.sensor].taken = ros::Time::now();
    sensors_[sight.sensor].refused.clear();
    const navvi_types::Obstacles told = perception_->obstacles(sight.stamp);
    navvi_msgs::Obstacles obstacles = navvi_types::to_msg(told);
    obstacles.header.frame_id = config_.map_frame;
    obstacles_.publish(obstacles);
    if (sight.sensor == 0 || sensors_.front().last == 0) show(told);
    if (const auto bytes = perception_->map(sight.stamp))
      map_.publish(map_msg(*bytes, config_.core.resolution(), sight.stamp, config_.map_frame));
  }

  void note_body(const sight::Sight& sight) {
    Sensor& sensor = sensors_[sight.sensor];
    if (sensor.sees_body) return;
    const double radius = config_.core.robot_radius();
    const auto inside =
        std::count_if(sight.hits.begin(), sight.hits.end(), [&](const Eigen::Vector3d& hit) {
          return (hit.head<2>() - sight.robot.position).norm() <= radius;
        });
    if (inside == 0) return;
    sensor.sees_body = true;
    ROS_INFO(
        "%s: %zu of %zu points lie within perception/robot_radius (%.2f m) of %s. They are "
             "the robot's own body, and left out.",
             sensor.topic.c_str(), static_cast<std::size_t>(inside), sight.hits.size(), radius,
             config_.base_frame.c_str());
  }

  void show(const navvi_types::Obstacles& obstacles) {
    if (seen_.getNumSubscribers() == 0) return;
    visualization_msgs::MarkerArray seen =
        seen_msg(perception_->standing(), config_.core.resolution(), obstacles, config_.map_frame);
    for (const auto& part : robot_markers(config_.core.robot_radius(), config_.core.robot_height(),
                                          config_.base_frame))
      seen.markers.push_back(part);
    seen_.publish(seen);
  }

  /// One that has to give sights, but gave none for long: a side, or a height, is not seen.
  [[nodiscard]] const Sensor* silent(const ros::Time& now) const {
    for (const Sensor& one : sensors_)
      if (!one.taken.isZero() && (now - one.taken).toSec() > kSilent + 1.0 / config_.cloud_rate)
        return &one;
    return nullptr;
  }

  /// By a sight that came within kFresh and is not old, and by all sensors that have to give one.
  [[nodiscard]] bool sees(const ros::Time& now) const {
    const double since = (now - taken_).toSec();
    const double age = (now - navvi_types::from_ns(sight_)).toSec();
    return sight_ != 0 && std::abs(since) <= kFresh && std::abs(age) <= SensorQueue::kOld &&
           silent(now) == nullptr;
  }

  /// Only where something publishes the bumper: else contacts are unknown, and not none.
  void tell_of_contacts(bool bumper) {
    if (!bumper) return contacts_.shutdown();
    if (!contacts_)
      contacts_ = ros::NodeHandle().advertise<navvi_msgs::Contact>("navvi/contacts", 100);
  }

  void tell_what_is_near() {
    tell_of_contacts(bumper_.getNumPublishers() > 0);
    serve();  // what waited in vain
    if (!sees(ros::Time::now())) return;
    const auto robot = robot_now();
    if (!robot) return;
    navvi_msgs::Proximity near = navvi_types::to_msg(perception_->proximity(*robot, sight_));
    near.header.frame_id = config_.base_frame;
    proximity_.publish(near);
  }

  /// Once a second; the log tells what is lost, and not again before it was back.
  void report() {
    using diagnostic_msgs::DiagnosticStatus;
    const ros::Time now = ros::Time::now();
    const bool seen = sees(now);
    std::string why = last_refusal_.empty() ? "no message came" : last_refusal_;
    if (const Sensor* const one = silent(now))
      why = one->topic + ": " + (one->refused.empty() ? "no message came" : one->refused);
    if (seen && std::exchange(lost_, false)) ROS_INFO("Obstacles are sensed again.");
    reports_ = seen ? kBegins : std::min(reports_ + 1, kBegins);
    if (!seen && reports_ == kBegins && !std::exchange(lost_, true))
      ROS_WARN("Obstacles are not sensed: no scan or cloud of late can be used (%s).", why.c_str());
    if (bumper_ && bumper_.getNumPublishers() == 0)
      ROS_WARN_DELAYED_THROTTLE(10.0, "Nothing publishes the bumper, %s: contacts are unknown.",
                                config_.bumper.c_str());
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = now;
    DiagnosticStatus& status = array.status.emplace_back();
    status.name = "navvi/sensing";
    status.level = !seen ? DiagnosticStatus::ERROR
                   : std::exchange(refused_, false) ? DiagnosticStatus::WARN
                                                    : DiagnosticStatus::OK;
    status.message = seen ? "Obstacles are sensed." : "Obstacles are not sensed: " + why + ".";
    for (const auto& [key, kind] : refusals_.kinds()) {
      diagnostic_msgs::KeyValue& pair = status.values.emplace_back();
      pair.key = kind.first;
      pair.value = std::to_string(kind.count) + " dropped";
    }
    diagnostics_.publish(array);
  }

  void on_bumper(const std_msgs::Bool& bumper) {
    tell_of_contacts(true);
    (void)robot_now();  // where it was last, if it is not known now
    if (bumper.data && !robot_) return;
    if (std::exchange(touches_, bumper.data) || !bumper.data) return;
    navvi_msgs::Contact msg = navvi_types::to_msg(
        perception_->bump(*robot_, ++bumps_, navvi_types::to_ns(ros::Time::now())));
    msg.header.frame_id = config_.map_frame;
    contacts_.publish(msg);
  }

  NodeConfig config_;
  sight::Prior prior_;
  std::unique_ptr<see::Perception> perception_;
  std::optional<navvi_types::Pose2> robot_;  ///< where it was last
  tf2_ros::Buffer buffer_;
  navvi_types::TransformListener listener_{buffer_, config_.odom_frame};
  boost::signals2::connection moved_;  ///< calls when a transform comes
  laser_geometry::LaserProjection projector_;
  ros::Publisher map_, obstacles_, proximity_, contacts_, seen_, diagnostics_;
  std::vector<Sensor> sensors_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber bumper_;
  ros::WallTimer timer_, report_timer_;
  std::int64_t sight_ = 0;    ///< ns, of the last sight
  ros::Time taken_;           ///< when it was
  int reports_ = 0;           ///< before obstacles were first sensed, up to kBegins
  bool lost_ = false;   ///< sensing, which was logged
  navvi_types::Once refusals_;
  std::string last_refusal_;
  bool refused_ = false;  ///< since the last report
  bool touches_ = false;
  std::uint32_t bumps_ = 0;  ///< goes on where time jumps back
};

}  // namespace
}  // namespace navvi_perception::node

int main(int argc, char** argv) {
  using navvi_perception::node::NodeConfig;
  if (const auto code = navvi_config::print_parameters<NodeConfig>(argc, argv)) return *code;
  navvi_config::init(argc, argv, "perception_node");
  return navvi_config::run_node<NodeConfig>([](NodeConfig config) {
    ros::NodeHandle node;
    // One height for what stands, what is near, and what the path leads under.
    config.core.set_robot_height(
        ros::param::param("nav_node/mesh/robot_height", navvi_types::kHeadroom));
    const navvi_perception::node::PerceptionNode perception(node, config);
    navvi_config::spin();
    return 0;
  });
}
