// Scans, clouds, a bumper and transforms in; OctoMap, obstacles, proximity and contacts out.

#include <laser_geometry/laser_geometry.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>
#include <tf2_ros/message_filter.h>

#include <cmath>
#include <memory>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>
#include <navvi_types/transform_listener.hpp>

#include "navvi_perception/see/perception.hpp"
#include "node/msg_conversion.hpp"

namespace navvi_perception::node {
namespace {

using sensor_msgs::LaserScan;
using sensor_msgs::PointCloud2;

constexpr double kRate = 20.0;          // Hz, of proximity
constexpr double kAhead = 0.2;          // s, that a stamp may lie in the future
constexpr double kOld = 1.0;            // s; an older message tells of another place
constexpr double kFresh = 0.5;          // s; older sights tell of nothing near
constexpr std::uint32_t kWaiting = 10;  // messages that wait for their transforms
constexpr std::size_t kScan = 0;        // sensors
constexpr std::size_t kCloud = 1;

struct NodeConfig {
  see::PerceptionConfig core;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::string prior;         ///< a file with an OctoMap; empty: the topic map is listened to
  std::string bumper;        ///< empty: none
  double cloud_rate = 10.0;  ///< Hz
  int cloud_points = 20000;

  void describe(navvi_config::Visitor& visit) {
    using navvi_config::Any;
    using navvi_config::Range;
    core.describe(visit);
    visit(map_frame, "map_frame", Any{}, "", "frame of the map and of all that is published");
    visit(base_frame, "base_frame", Any{}, "", "frame of the robot");
    visit(
        prior, "prior", Any{}, "",
        "file .bt or .ot with the OctoMap of what stands for good, used in place of the topic map");
    visit(bumper, "bumper", Any{}, "",
          "topic with std_msgs/Bool, true while something is touched; empty: contacts are unknown");
    visit(cloud_rate, "cloud_rate", Range{0.1, 100.0}, "Hz", "clouds that come faster are skipped");
    visit(cloud_points, "cloud_points", Range{100, 1000000}, "",
          "of a cloud that are used at most, evenly spread");
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
    scans_.registerCallback([this](const LaserScan::ConstPtr& scan) { on_scan(*scan); });
    clouds_.registerCallback([this](const PointCloud2::ConstPtr& cloud) { on_cloud(*cloud); });
    const auto no_transform = [this](const auto& msg, auto) {
      refuse(msg->header, "no transform leads from its frame to " + config_.map_frame);
    };
    scans_.registerFailureCallback(no_transform);
    clouds_.registerFailureCallback(no_transform);
    subscribers_ = {listen<LaserScan>(node, "scan", scans_),
                    listen<PointCloud2>(node, "points", clouds_)};
    if (config.prior.empty())
      subscribers_.push_back(navvi_types::subscribe<nav_msgs::OccupancyGrid>(
          node, "map", 1, from_msg, [this](const sight::Prior& prior) { know(prior); },
          config.map_frame));
    else
      know(config.core.prior_of(config.prior));
    if (!config.bumper.empty()) {
      contacts_ = node.advertise<navvi_msgs::Contact>("navvi/contacts", 100);
      subscribers_.push_back(node.subscribe(config.bumper, 10, &PerceptionNode::on_bumper, this));
    }
    timer_ = node.createWallTimer(ros::WallDuration(1.0 / kRate),
                                  [this](const ros::WallTimerEvent&) { tell_what_is_near(); });
    ROS_INFO(
        "Whatever is seen is called other, or wall if it stands and is long; what lies outside the "
        "sensors' sight is not known, so %s. Contacts: %s.",
        "a lidar alone misses what ends below its plane and what hangs above it",
        config.bumper.empty() ? "unknown, as there is no bumper" : config.bumper.c_str());
  }

 private:
  template <typename Message>
  ros::Subscriber listen(ros::NodeHandle& node, const char* topic,
                         tf2_ros::MessageFilter<Message>& filter) {
    return navvi_types::subscribe<Message>(
        node, topic, kWaiting, from_msg, [this, &filter](const typename Message::ConstPtr& msg) {
          const double age = (ros::Time::now() - msg->header.stamp).toSec();
          if (age < -kAhead)
            refuse(msg->header, "its stamp lies in the future");
          else if (age > kOld)
            refuse(msg->header, "it is too old");
          else
            filter.add(msg);
        });
  }

  void refuse(const std_msgs::Header& header, const std::string& why) {
    ++refused_;
    ROS_WARN_THROTTLE(5.0, "What was seen from frame %s was dropped: %s (%u so far).",
                      header.frame_id.c_str(), why.c_str(), refused_);
  }

  /// Begins afresh.
  void know(const sight::Prior& prior) {
    prior_ = prior;
    perception_ = std::make_unique<see::Perception>(config_.core, prior_);
    ROS_INFO("A prior map of %d x %d cells is known.", prior.width, prior.height);
  }

  void on_scan(const LaserScan& scan) {
    sight::Sight sight;
    if (!begin(scan.header, kScan, sight)) return;
    try {
      PointCloud2 cloud;
      projector_.transformLaserScanToPointCloud(config_.map_frame, with_clear_rays(scan), cloud,
                                                buffer_, static_cast<double>(scan.range_max),
                                                laser_geometry::channel_option::Index);
      add_points(scan, cloud, sight);
    } catch (const tf2::TransformException& error) {
      return refuse(scan.header, error.what());
    }
    take(sight);
  }

  void on_cloud(const PointCloud2& cloud) {
    const double since = (cloud.header.stamp - navvi_types::from_ns(last_[kCloud])).toSec();
    sight::Sight sight;
    if ((since >= 0.0 && since * config_.cloud_rate < 1.0) || !begin(cloud.header, kCloud, sight))
      return;
    const std::optional<Eigen::Isometry3d> pose = in_map(cloud.header.frame_id, cloud.header.stamp);
    if (!pose) return;
    sight.in_plane = false;
    sight.hits = points_of(cloud, static_cast<std::size_t>(config_.cloud_points));
    for (Eigen::Vector3d& hit : sight.hits) hit = *pose * hit;
    take(sight);
  }

  /// Fills in all but the points. \return false if it cannot be used
  bool begin(const std_msgs::Header& header, std::size_t sensor, sight::Sight& sight) {
    (void)robot_now();  // a transform from the future would bend those before it
    const auto eye = in_map(header.frame_id, header.stamp);
    const auto robot = in_map(config_.base_frame, header.stamp);
    if (!eye || !robot) return false;
    sight.stamp = navvi_types::to_ns(header.stamp);
    if ((navvi_types::from_ns(last_[sensor]) - header.stamp).toSec() > kOld) {
      ROS_WARN("Time jumped back; what was seen is forgotten.");
      know(prior_);
      last_ = {};
    } else if (sight.stamp < last_[sensor]) {
      refuse(header, "a later one came before it");
      return false;
    }
    last_[sensor] = sight.stamp;
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
      std_msgs::Header header;
      header.frame_id = frame;
      refuse(header, error.what());
      return std::nullopt;
    }
  }

  std::optional<navvi_types::Pose2> robot_now() {
    const auto found =
        navvi_types::newest(buffer_, config_.map_frame, config_.base_frame, ros::Time::now());
    const auto pose = found ? pose_of(found->transform) : std::nullopt;
    return pose ? std::optional(flat(*pose)) : std::nullopt;
  }

  void take(const sight::Sight& sight) {
    perception_->take(sight);
    sight_ = sight.stamp;
    const navvi_types::Obstacles told = perception_->obstacles(sight.stamp);
    navvi_msgs::Obstacles obstacles = navvi_types::to_msg(told);
    obstacles.header.frame_id = config_.map_frame;
    obstacles_.publish(obstacles);
    if (sight.sensor == kScan || last_[kScan] == 0) show(told);
    if (const auto bytes = perception_->map(sight.stamp))
      map_.publish(map_msg(*bytes, config_.core.resolution(), sight.stamp, config_.map_frame));
  }

  void show(const navvi_types::Obstacles& obstacles) {
    if (seen_.getNumSubscribers() == 0) return;
    seen_.publish(
        seen_msg(perception_->standing(), config_.core.resolution(), obstacles, config_.map_frame));
  }

  void tell_what_is_near() {
    const double age = (ros::Time::now() - navvi_types::from_ns(sight_)).toSec();
    if (sight_ == 0 || std::abs(age) > kFresh) {
      // Not while all begins.
      ROS_WARN_DELAYED_THROTTLE(
          10.0, "Nothing is seen: no scan or cloud of the last %.1f s can be used.", kFresh);
      return;
    }
    const auto robot = robot_now();
    if (!robot) return;
    navvi_msgs::Proximity near = navvi_types::to_msg(perception_->proximity(*robot, sight_));
    near.header.frame_id = config_.base_frame;
    proximity_.publish(near);
  }

  void on_bumper(const std_msgs::Bool& bumper) {
    const bool begins = bumper.data && !touches_;
    touches_ = bumper.data;
    const auto robot = begins ? robot_now() : std::nullopt;
    if (!robot) return;
    navvi_msgs::Contact msg =
        navvi_types::to_msg(perception_->bump(*robot, navvi_types::to_ns(ros::Time::now())));
    msg.header.frame_id = config_.map_frame;
    contacts_.publish(msg);
  }

  NodeConfig config_;
  sight::Prior prior_;
  std::unique_ptr<see::Perception> perception_;
  tf2_ros::Buffer buffer_;
  navvi_types::TransformListener listener_{buffer_};
  tf2_ros::MessageFilter<LaserScan> scans_{buffer_, config_.map_frame, kWaiting, nullptr};
  tf2_ros::MessageFilter<PointCloud2> clouds_{buffer_, config_.map_frame, kWaiting, nullptr};
  laser_geometry::LaserProjection projector_;
  ros::Publisher map_, obstacles_, proximity_, contacts_, seen_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
  std::array<std::int64_t, 2> last_{};  ///< ns, the last stamp of each sensor
  std::int64_t sight_ = 0;              ///< ns, of the last sight
  unsigned refused_ = 0;
  bool touches_ = false;
};

}  // namespace
}  // namespace navvi_perception::node

int main(int argc, char** argv) {
  using navvi_perception::node::NodeConfig;
  if (const auto code = navvi_config::print_parameters<NodeConfig>(argc, argv)) return *code;
  ros::init(argc, argv, "perception_node");
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    ros::NodeHandle node;
    const navvi_perception::node::PerceptionNode perception(node, config);
    ros::spin();
    return 0;
  });
}
