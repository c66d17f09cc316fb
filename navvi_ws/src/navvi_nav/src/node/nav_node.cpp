// OctoMap, obstacles, pose and goal in; path, guidance and mesh out.

#include <nav_msgs/GetPlan.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <navvi_config/ros_parameters.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/subscribe.hpp>
#include <navvi_types/transform_listener.hpp>

#include "guide/navigator.hpp"
#include "guide/publish_throttle.hpp"
#include "node/goal_action.hpp"
#include "node/msg_conversion.hpp"
#include "plan/worker.hpp"

namespace navvi_nav::node {
namespace {

using navvi_types::Guidance;
using navvi_types::Pose2;

constexpr double kServicePatience = 1.0;  // s
constexpr double kMeshPeriod = 0.5;  // s, between pictures of the mesh; a large one's is longer
constexpr double kBeat = 0.05;       // s, where nothing wakes the node sooner

/// Work for the node's own thread, from any other.
class Wake : public ros::CallbackInterface {
 public:
  explicit Wake(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  std::function<void()> work_;
};

/// As it came, with its frame.
std::optional<nav_msgs::Odometry> checked(const nav_msgs::Odometry& msg) {
  return navvi_types::from_msg(msg) ? std::optional(msg) : std::nullopt;
}

struct NodeConfig {
  guide::NavigatorConfig navigator;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  std::string odom_frame = "odom";

  void describe(navvi_config::Visitor& visit) {
    navigator.describe(visit);
    visit(map_frame, "map_frame", navvi_config::Any{}, "",
          "frame of the map and of all that is published");
    visit(base_frame, "base_frame", navvi_config::Any{}, "", "frame of the robot");
    visit(odom_frame, "odom_frame", navvi_config::Any{}, "",
          "frame of odometry, which a localizer places in the map");
  }
};

class NavNode {
 public:
  NavNode(ros::NodeHandle node, const NodeConfig& config)
      : config_(config),
        navigator_(config.navigator),
        worker_(config.navigator.planner,
                [this] {
                  ros::getGlobalCallbackQueue()->addCallback(
                      boost::make_shared<Wake>([this] { beat(); }));
                }),
        mesh_throttle_(kMeshPeriod) {
    path_ = node.advertise<nav_msgs::Path>("navvi/path", 1, true);
    guidance_ = node.advertise<navvi_msgs::Guidance>("navvi/guidance", 10);
    if (!config.navigator.planner.mesh.zones.empty()) {
      zone_ = node.advertise<navvi_msgs::Zone>("navvi/zone", 1);
      borders_ = node.advertise<visualization_msgs::MarkerArray>("navvi/zones", 1, true);
    }
    mesh_ = node.advertise<visualization_msgs::MarkerArray>("navvi/navmesh", 1, true);
    subscribers_ = {
        node.subscribe("octomap_binary", 1, &NavNode::on_map, this),
        navvi_types::subscribe<nav_msgs::OccupancyGrid>(
            node, "map", 1, from_msg,
            [this](const map::OccupancyGrid& grid) {
              if (!navigator_.set_map(std::make_shared<const map::OccupancyGrid>(grid)))
                ROS_WARN_ONCE("The occupancy grid is ignored: an OctoMap came before.");
            },
            config.map_frame),
        navvi_types::subscribe<navvi_msgs::Obstacles>(
            node, "navvi/obstacles", 1, navvi_types::from_msg,
            [this](const navvi_types::Obstacles& obstacles) {
              take(obstacles, ros::Time::now().toSec());
              beat();
            },
            config.map_frame, [this](const std::string&) { navigator_.reject_obstacles(); }),
        navvi_types::subscribe<nav_msgs::Odometry>(
            node, "odom", 1, checked, [this](const nav_msgs::Odometry& msg) { on_odometry(msg); }),
        navvi_types::subscribe<navvi_msgs::LinkState>(
            node, "navvi/link", 1, navvi_types::from_msg,
            [this](const auto& link) { navigator_.set_foresight(link.foresight); }),
        node.subscribe("move_base_simple/goal", 10, &NavNode::on_goal, this)};
    goals_ = node.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
    action_.emplace(
        node,
        [this](geometry_msgs::PoseStamped& goal) {
          goal = in_map(goal).value_or(goal);
          goals_.publish(goal);
        },
        [this] {
          navigator_.cancel_goal();
          publish_all();
        });
    make_plan_ = node.advertiseService("move_base/make_plan", &NavNode::on_make_plan, this);
    timer_ = node.createWallTimer(ros::WallDuration(kBeat),
                                  [this](const ros::WallTimerEvent&) { beat(); });
    name_frames();
    navvi_config::await_readers(guidance_);
    publish_path();
  }

 private:
  /// map and base_link for those who know frames by the names of REP-105 alone.
  void name_frames() {
    std::vector<geometry_msgs::TransformStamped> same;
    const auto add = [&](const std::string& parent, const std::string& child) {
      if (parent == child) return;
      geometry_msgs::TransformStamped& transform = same.emplace_back();
      transform.header.frame_id = parent;
      transform.child_frame_id = child;
      transform.transform.rotation.w = 1.0;
    };
    add("map", config_.map_frame);
    add(config_.base_frame, "base_link");
    if (!same.empty()) frames_.emplace().sendTransform(same);
  }

  void on_map(const octomap_msgs::Octomap::ConstPtr& msg) {
    const std::string error = error_of(*msg, config_.map_frame);
    if (!error.empty())
      ROS_ERROR("The map is refused: %s.", error.c_str());
    else
      navigator_.set_map(std::make_shared<const plan::MapMessage>(from_msg(*msg)));
  }

  void take(const navvi_types::Obstacles& obstacles, double now) {
    using Times = guide::ObservationConfig;
    const double age = now - 1e-9 * static_cast<double>(obstacles.stamp);
    if (obstacles.stamp == 0 || (age <= Times::kObstacleTimeout && age >= -Times::kMostAhead))
      navigator_.set_obstacles(obstacles.things, now);
    else
      ROS_WARN_THROTTLE(5.0, "Obstacles were dropped: they are stamped %.1f s ago.", age);
  }

  void on_goal(const geometry_msgs::PoseStamped::ConstPtr& msg) {
    const std::optional<Eigen::Vector2d> goal = navvi_types::from_msg(*msg);
    if (!goal) {
      drop_goal(*msg, Guidance::Refusal::not_finite, "the goal is not a finite point");
    } else if (navvi_types::without_slash(msg->header.frame_id) == "map") {
      action_->take(*msg);
      navigator_.set_goal(*goal, msg->header.stamp.toSec());
    } else if (const auto there = in_map(*msg)) {
      goals_.publish(*there);  // also for those who record and remember goals
    } else {
      drop_goal(*msg, Guidance::Refusal::unknown_frame, "the goal's frame is not known");
    }
    publish_all();
  }

  std::optional<geometry_msgs::PoseStamped> in_map(const geometry_msgs::PoseStamped& goal) const {
    const auto there = in_map_frame(*navvi_types::from_msg(goal), goal.header);
    if (!there) return std::nullopt;
    return navvi_types::goal_msg(*there, navvi_types::to_ns(goal.header.stamp));
  }

  void drop_goal(const geometry_msgs::PoseStamped& goal, Guidance::Refusal refusal,
                 const char* what) {
    ++bad_goals_;
    action_->drop(goal, what);
    const bool stands = navigator_.drop_bad_goal(refusal, what);
    ROS_WARN("A goal message is dropped: %s%s (%u so far).", what,
             stands ? "; the goal before it stands" : "", bad_goals_);
  }

  /// As move_base: without a frame the plan starts at the robot; where nothing leads to the goal,
  /// the plan is empty: no goal is moved, whatever the tolerance; false means that nothing could be
  /// planned.
  bool on_make_plan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response) {
    const ros::Time now = ros::Time::now();
    const std::optional<Pose2> robot = navigator_.pose(now.toSec());
    const bool from_robot = request.start.header.frame_id.empty();
    if (!navigator_.has_map() || (from_robot && !robot)) {
      ROS_ERROR("No plan can be made: there is no %s.", robot ? "map yet" : "map or pose");
      return false;
    }
    response.plan.header.frame_id = config_.map_frame;
    response.plan.header.stamp = now;
    const auto place = [this](const geometry_msgs::PoseStamped& pose) {
      const std::optional<Eigen::Vector2d> point = navvi_types::from_msg(pose);
      return point ? in_map_frame(*point, pose.header) : std::nullopt;
    };
    const std::optional<Eigen::Vector2d> start =
        from_robot ? robot->position : place(request.start);
    const std::optional<Eigen::Vector2d> goal = place(request.goal);
    if (!start || !goal) return true;
    const std::optional<plan::Plan> plan =
        worker_.ask(guide::to_point(*start), guide::to_point(*goal), kServicePatience);
    if (!plan) {
      ROS_ERROR("No plan can be made: the planner is busy with a map.");
      return false;
    }
    ROS_DEBUG("make_plan: %s", plan->detail.c_str());
    response.plan = path_msg(plan->path, now);
    return true;
  }

  nav_msgs::Path path_msg(const Path& path, const ros::Time& now) const {
    return navvi_types::path_msg(guide::to_vectors(path), navigator_.floor_height(),
                                 navvi_types::to_ns(now), config_.map_frame);
  }

  std::optional<Eigen::Vector2d> in_map_frame(const Eigen::Vector2d& point,
                                              const std_msgs::Header& header) const {
    if (header.frame_id == config_.map_frame) return point;
    try {
      const std::optional<Pose2> frame = navvi_types::from_msg(
          buffer_.lookupTransform(config_.map_frame, header.frame_id, ros::Time(0)).transform);
      return frame ? std::optional(frame->to_parent(point)) : std::nullopt;
    } catch (const tf2::TransformException& error) {
      ROS_WARN_DELAYED_THROTTLE(5.0, "A place in frame %s is not known in the map: %s",
                                header.frame_id.c_str(), error.what());
      return std::nullopt;
    }
  }

  /// Where there is none, the age of the last one shows it.
  void read_pose(const ros::Time& now) {
    const auto found = navvi_types::newest(buffer_, config_.map_frame, config_.base_frame, now);
    const auto pose = found ? navvi_types::from_msg(found->transform) : std::nullopt;
    if (!pose) return;
    posed_ = found->header.stamp.toSec();
    navigator_.set_pose(*pose, found->transform.translation.z, posed_);
  }

  void on_odometry(const nav_msgs::Odometry& msg) {
    const navvi_types::Odometry odometry = *navvi_types::from_msg(msg);
    navigator_.set_velocity(odometry.velocity);
    navigator_.set_odometry_place(in_map_frame(odometry.pose.position, msg.header));
  }

  /// At least at 20 Hz; at once when obstacles or a finished plan come.
  void beat() {
    const double now = ros::Time::now().toSec();
    if (now < last_time_) {
      ROS_WARN("Time jumped back; poses and obstacles start afresh.");
      navigator_.reset_times(now - last_time_);
    }
    last_time_ = now;
    if (ros::Time::isValid()) read_pose(ros::Time(now));
    if (const std::optional<plan::PlanAnswer> answer = worker_.take()) {
      report(*answer);
      navigator_.deliver(*answer, now);
      publish_mesh(*answer);
      if (answer->map_taken && borders_)
        borders_.publish(to_msg(navigator_.zones(), navigator_.floor_height(), config_.map_frame,
                                ros::Time::now()));
    }
    const bool lost_before = navigator_.obstacles_lost();
    if (std::optional<plan::PlanRequest> request = navigator_.update(now)) {
      request->show_mesh = mesh_throttle_.due(ros::SteadyTime::now().toSec());
      worker_.start(std::move(*request));
    }
    if (navigator_.obstacles_lost() && !lost_before)
      ROS_WARN("Obstacle messages have stopped: plans ignore moving things, and waits will end.");
    publish_all();
  }

  void report(const plan::PlanAnswer& answer) const {
    if (answer.map_taken) {
      ROS_INFO_ONCE("Map taken in %.3f s: %zu polygons in %d tiles. Later maps are taken unsaid.",
                    answer.seconds, answer.polygons, answer.mesh.tiles);
    } else if (!answer.map_error.empty()) {
      ROS_ERROR("The map is refused: %s.", answer.map_error.c_str());
    }
  }

  void publish_all() {
    const double now = ros::Time::now().toSec();
    std::optional<navvi_types::ZoneState> zone = navigator_.zone(now);
    // Of each pose once: the gate must see where none comes any more.
    if (zone && std::exchange(zoned_, posed_) != posed_) {
      zone->stamp = navvi_types::to_ns(ros::Time::now());
      navvi_msgs::Zone msg = navvi_types::to_msg(*zone);
      msg.header.frame_id = config_.map_frame;
      zone_.publish(msg);
    }
    publish_path();
    if (navigator_.undecided(now)) return;
    Guidance guidance = navigator_.guidance(now);
    if (!throttle_.due(guidance, ros::SteadyTime::now().toSec())) return;
    guidance.stamp = navvi_types::to_ns(ros::Time::now());
    guidance.seq = ++seq_;
    navvi_msgs::Guidance msg = navvi_types::to_msg(guidance);
    msg.header.frame_id = config_.map_frame;
    guidance_.publish(msg);
    action_->report(msg, pose_msg(now));
  }

  [[nodiscard]] geometry_msgs::PoseStamped pose_msg(double now) const {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = config_.map_frame;
    pose.header.stamp = ros::Time::now();
    pose.pose.orientation.w = 1.0;
    if (const std::optional<Pose2> robot = navigator_.pose(now))
      pose.pose = navvi_types::pose_msg(*robot, 0.0);
    return pose;
  }

  void publish_path() {
    if (shown_path_ && *shown_path_ == navigator_.path()) return;
    shown_path_ = navigator_.path();
    path_.publish(path_msg(*shown_path_, ros::Time::now()));
  }

  void publish_mesh(const plan::PlanAnswer& answer) {
    if (!answer.navmesh || answer.navmesh == shown_mesh_) return;
    shown_mesh_ = answer.navmesh;
    mesh_throttle_.published(shown_mesh_->polygons.size(), ros::SteadyTime::now().toSec());
    mesh_.publish(
        to_msg(*shown_mesh_, navigator_.floor_height(), config_.map_frame, ros::Time::now()));
  }

  NodeConfig config_;
  guide::Navigator navigator_;
  plan::Worker worker_;
  tf2_ros::Buffer buffer_;
  navvi_types::TransformListener listener_{buffer_, config_.odom_frame};
  std::optional<tf2_ros::StaticTransformBroadcaster> frames_;
  ros::Publisher path_;
  ros::Publisher guidance_;
  ros::Publisher zone_, borders_;  ///< none without zones
  ros::Publisher goals_;
  std::optional<GoalAction> action_;
  ros::Publisher mesh_;
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer make_plan_;
  ros::WallTimer timer_;
  std::optional<Path> shown_path_;
  std::shared_ptr<const mesh::Mesh> shown_mesh_;
  guide::PublishThrottle throttle_;
  guide::MeshThrottle mesh_throttle_;
  double last_time_ = 0.0;
  double posed_ = 0.0, zoned_ = 0.0;  ///< s, stamp of the last pose, and of that of the last zone
  std::uint32_t seq_ = 0;
  unsigned bad_goals_ = 0;
};

}  // namespace
}  // namespace navvi_nav::node

int main(int argc, char** argv) {
  using navvi_nav::node::NodeConfig;
  const auto check = [](const NodeConfig& config) {
    static_cast<void>(navvi_floor::Zones(config.navigator.planner.mesh.zones));
    return YAML::Node(YAML::NodeType::Map);
  };
  if (const auto code = navvi_config::print_parameters<NodeConfig>(argc, argv, check)) return *code;
  navvi_config::ask_for_priority(-5);
  navvi_config::init(argc, argv, "nav_node");
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    ros::NodeHandle node;
    const navvi_nav::node::NavNode nav(node, config);
    navvi_config::spin();
    return 0;
  });
}
