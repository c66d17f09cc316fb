// OctoMap, obstacles, pose and goal in; path, guidance and mesh out.

#include <nav_msgs/GetPlan.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <map>
#include <navvi_config/ros_parameters.hpp>

#include "navvi_nav/guide/publish_throttle.hpp"
#include "navvi_nav/node/msg_conversion.hpp"
#include "plan/worker.hpp"

namespace navvi_nav::node {
namespace {

constexpr double kServicePatience = 1.0;  // s

struct NodeConfig {
  guide::NavigatorConfig navigator;
  std::string map_frame = "map";
  std::string base_frame = "base_link";
  double mesh_period = 0.5;

  void describe(navvi_config::Visitor& visit) {
    using navvi_config::Range;
    navigator.describe(visit);
    visit(map_frame, "map_frame", navvi_config::Any{}, "",
          "frame of the map and of all that is published");
    visit(base_frame, "base_frame", navvi_config::Any{}, "", "frame of the robot");
    visit(mesh_period, "mesh_period", Range{0.1, 60.0}, "s",
          "least time between two pictures of the mesh; a large mesh waits longer");
  }
};

class NavNode {
 public:
  NavNode(ros::NodeHandle node, const NodeConfig& config)
      : config_(config),
        navigator_(config.navigator),
        worker_(config.navigator.planner),
        mesh_throttle_(config.mesh_period) {
    path_ = node.advertise<nav_msgs::Path>("navvi/path", 1, true);
    guidance_ = node.advertise<navvi_msgs::Guidance>("navvi/guidance", 10);
    mesh_ = node.advertise<visualization_msgs::MarkerArray>("navvi/navmesh", 1, true);
    subscribers_ = {node.subscribe("octomap_binary", 1, &NavNode::on_map, this),
                    node.subscribe("map", 1, &NavNode::on_grid, this),
                    node.subscribe("navvi/obstacles", 1, &NavNode::on_obstacles, this),
                    node.subscribe("odom", 1, &NavNode::on_odometry, this),
                    node.subscribe("move_base_simple/goal", 1, &NavNode::on_goal, this)};
    make_plan_ = node.advertiseService("move_base/make_plan", &NavNode::on_make_plan, this);
    timer_ = node.createWallTimer(ros::WallDuration(0.05), &NavNode::on_timer, this);
    publish_path();
  }

 private:
  void on_map(const octomap_msgs::Octomap::ConstPtr& msg) {
    const std::string error = error_of(*msg, config_.map_frame);
    if (!error.empty())
      ROS_ERROR("The map is refused: %s.", error.c_str());
    else
      navigator_.set_map(std::make_shared<const plan::MapMessage>(from_msg(*msg)));
  }

  void on_grid(const nav_msgs::OccupancyGrid::ConstPtr& msg) {
    std::optional<map::OccupancyGrid> grid = from_msg(*msg, config_.map_frame);
    if (!grid) {
      ROS_ERROR("The occupancy grid is refused: it is not a flat grid in frame '%s'.",
                config_.map_frame.c_str());
    } else if (!navigator_.set_map(std::make_shared<const map::OccupancyGrid>(std::move(*grid)))) {
      ROS_WARN("The occupancy grid is ignored: an OctoMap came before.");
    }
  }

  void on_obstacles(const navvi_msgs::Obstacles::ConstPtr& msg) {
    const std::optional<std::vector<guide::MovingThing>> obstacles = from_msg(*msg);
    if (!obstacles || msg->header.frame_id != config_.map_frame) {
      ++bad_messages_;
      ROS_WARN_THROTTLE(5.0, "Obstacles with a bad number or frame are dropped (%u bad messages).",
                        bad_messages_);
      return;
    }
    classes_.clear();
    for (const auto& obstacle : msg->obstacles) classes_[obstacle.id] = obstacle.thing_class;
    navigator_.set_obstacles(*obstacles, ros::Time::now().toSec());
  }

  void on_odometry(const nav_msgs::Odometry::ConstPtr& msg) {
    const std::optional<double> speed = speed_from_msg(*msg);
    if (speed) {
      navigator_.set_speed(*speed);
      return;
    }
    ++bad_messages_;
    ROS_WARN_THROTTLE(5.0, "Odometry with a bad number is dropped (%u bad messages).",
                      bad_messages_);
  }

  void on_goal(const geometry_msgs::PoseStamped::ConstPtr& msg) {
    const std::optional<Point> goal = from_msg(*msg);
    if (!goal) {
      drop_goal(plan::Refusal::not_finite, "the goal is not a finite point");
    } else if (const std::optional<Point> there = in_map_frame(*goal, msg->header)) {
      navigator_.set_goal(*there);
    } else {
      drop_goal(plan::Refusal::unknown_frame, "the goal's frame is not known");
    }
    publish_all();
  }

  void drop_goal(plan::Refusal refusal, const char* what) {
    ++bad_messages_;
    const bool stands = navigator_.drop_bad_goal(refusal, what);
    ROS_WARN("A goal message is dropped: %s%s (%u bad messages).", what,
             stands ? "; the goal before it stands" : "", bad_messages_);
  }

  /// As move_base: without a frame the plan starts at the robot; where nothing leads to the goal or
  /// within the tolerance of it, the plan is empty; false means that nothing could be planned.
  bool on_make_plan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response) {
    const ros::Time now = ros::Time::now();
    const std::optional<Pose> robot = navigator_.pose(now.toSec());
    const bool from_robot = request.start.header.frame_id.empty();
    if (!navigator_.has_map() || (from_robot && !robot)) {
      ROS_ERROR("No plan can be made: there is no %s.", robot ? "map yet" : "map or pose");
      return false;
    }
    response.plan.header.frame_id = config_.map_frame;
    response.plan.header.stamp = now;
    const auto place = [this](const geometry_msgs::PoseStamped& pose) {
      const std::optional<Point> point = from_msg(pose);
      return point ? in_map_frame(*point, pose.header) : std::nullopt;
    };
    const std::optional<Point> start = from_robot ? robot->position : place(request.start);
    const std::optional<Point> goal = place(request.goal);
    if (!start || !goal) return true;
    const std::optional<plan::Plan> plan =
        worker_.ask(*start, *goal, static_cast<double>(request.tolerance), kServicePatience);
    if (!plan) {
      ROS_ERROR("No plan can be made: the planner is busy with a map.");
      return false;
    }
    ROS_DEBUG("make_plan: %s", plan->detail.c_str());
    response.plan = to_msg(plan->path, navigator_.floor_height(), config_.map_frame, now);
    return true;
  }

  std::optional<Point> in_map_frame(Point point, const std_msgs::Header& header) const {
    if (header.frame_id == config_.map_frame) return point;
    try {
      const std::optional<Pose> frame = from_msg(
          buffer_.lookupTransform(config_.map_frame, header.frame_id, ros::Time(0)).transform);
      if (!frame) return std::nullopt;
      return to_parent(*frame, point);
    } catch (const tf2::TransformException& error) {
      ROS_WARN("Goal: %s", error.what());
      return std::nullopt;
    }
  }

  void read_pose() {
    try {
      const geometry_msgs::TransformStamped transform =
          buffer_.lookupTransform(config_.map_frame, config_.base_frame, ros::Time(0));
      if (const std::optional<Pose> pose = from_msg(transform.transform))
        navigator_.set_pose(*pose, transform.header.stamp.toSec());
    } catch (const tf2::TransformException&) {
      // The age of the pose shows it.
    }
  }

  void on_timer(const ros::WallTimerEvent&) {
    const double now = ros::Time::now().toSec();
    if (now < last_time_) {
      ROS_WARN("Time jumped back; poses and obstacles start afresh.");
      buffer_.clear();
      navigator_.reset_times();
    }
    last_time_ = now;
    read_pose();
    if (const std::optional<plan::PlanAnswer> answer = worker_.take()) {
      report(*answer);
      navigator_.deliver(*answer, now);
      publish_mesh(*answer);
    }
    const bool lost_before = navigator_.obstacles_lost();
    if (std::optional<plan::PlanRequest> request = navigator_.update(now)) {
      request->show_mesh = mesh_throttle_.due(ros::SteadyTime::now().toSec());
      worker_.start(std::move(*request));
    }
    if (navigator_.obstacles_lost() && !lost_before)
      ROS_WARN("No fresh obstacles come any more; moving things are not in the path.");
    publish_all();
  }

  void report(const plan::PlanAnswer& answer) const {
    if (answer.map_taken) {
      ROS_INFO("Map taken in %.3f s: %zu polygons in %d tiles, %d tiles changed.", answer.seconds,
               answer.polygons, answer.mesh.tiles, answer.mesh.tiles_rebuilt);
    } else if (!answer.map_error.empty()) {
      ROS_ERROR("The map is refused: %s.", answer.map_error.c_str());
    }
  }

  void publish_all() {
    const double now = ros::Time::now().toSec();
    publish_path();
    if (navigator_.undecided(now)) return;
    const guide::Status status = navigator_.status(now);
    if (!throttle_.due(status, ros::SteadyTime::now().toSec())) return;
    navvi_msgs::Guidance msg =
        to_msg(status, navigator_.floor_height(), config_.map_frame, ros::Time::now());
    msg.seq = ++seq_;
    if (status.blocked) msg.blocked_by = classes_[status.blocked->by];
    guidance_.publish(msg);
  }

  void publish_path() {
    if (shown_path_ && *shown_path_ == navigator_.path()) return;
    shown_path_ = navigator_.path();
    path_.publish(
        to_msg(*shown_path_, navigator_.floor_height(), config_.map_frame, ros::Time::now()));
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
  tf2_ros::TransformListener listener_{buffer_};
  ros::Publisher path_;
  ros::Publisher guidance_;
  ros::Publisher mesh_;
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer make_plan_;
  ros::WallTimer timer_;
  std::map<std::uint32_t, std::string> classes_;  // of the obstacles, by id
  std::optional<Path> shown_path_;
  std::shared_ptr<const mesh::Mesh> shown_mesh_;
  guide::PublishThrottle throttle_;
  guide::MeshThrottle mesh_throttle_;
  double last_time_ = 0.0;
  unsigned seq_ = 0;
  unsigned bad_messages_ = 0;
};

}  // namespace
}  // namespace navvi_nav::node

int main(int argc, char** argv) {
  using navvi_nav::node::NodeConfig;
  if (navvi_config::print_parameters<NodeConfig>(argc, argv)) return 0;
  ros::init(argc, argv, "nav_node");
  return navvi_config::run_node<NodeConfig>([](const NodeConfig& config) {
    ros::NodeHandle node;
    const navvi_nav::node::NavNode nav(node, config);
    ros::spin();
    return 0;
  });
}
