#include "navvi_nav/node/msg_conversion.hpp"

#include <set>

namespace navvi_nav::node {
namespace {

constexpr double kMaxSpeed = 100.0;  // m/s
constexpr double kMaxSize = 20.0;    // m
constexpr std::size_t kMaxObstacles = 10000;
constexpr std::uint32_t kMaxGridSide = 1000000;  // cells
constexpr float kMeshAlpha = 0.35F;
constexpr double kAboveFloor = 0.02;  // m

bool within(double value, double limit) { return std::isfinite(value) && std::abs(value) <= limit; }

template <typename Vector>
bool within_each(const Vector& vector, double limit) {
  return within(vector.x, limit) && within(vector.y, limit) && within(vector.z, limit);
}

bool rotation(const geometry_msgs::Quaternion& q) {
  const double length2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return std::isfinite(length2) && std::abs(length2 - 1.0) < 0.1;
}

double yaw_of(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

geometry_msgs::Point point_msg(Point point, double z) {
  geometry_msgs::Point out;
  out.x = point.x;
  out.y = point.y;
  out.z = z;
  return out;
}

}  // namespace

std::optional<Pose> from_msg(const geometry_msgs::Transform& transform) {
  if (!within_each(transform.translation, kFarthest) || !rotation(transform.rotation))
    return std::nullopt;
  return Pose{{transform.translation.x, transform.translation.y}, yaw_of(transform.rotation)};
}

std::optional<double> speed_from_msg(const nav_msgs::Odometry& odometry) {
  const auto& twist = odometry.twist.twist;
  if (!within_each(twist.linear, kMaxSpeed) || !within_each(twist.angular, kMaxSpeed))
    return std::nullopt;
  return twist.linear.x;
}

std::optional<std::vector<guide::MovingThing>> from_msg(const navvi_msgs::Obstacles& obstacles) {
  if (obstacles.obstacles.size() > kMaxObstacles) return std::nullopt;
  std::vector<guide::MovingThing> out;
  std::set<std::uint32_t> ids;
  for (const navvi_msgs::Obstacle& obstacle : obstacles.obstacles) {
    const bool sound =
        within_each(obstacle.pose.position, kFarthest) && rotation(obstacle.pose.orientation) &&
        within_each(obstacle.velocity, kMaxSpeed) && within(obstacle.radius, kMaxSize) &&
        obstacle.radius > 0.0 && within(obstacle.height, kMaxSize) && obstacle.height > 0.0 &&
        ids.insert(obstacle.id).second;
    if (!sound) return std::nullopt;
    const Point at{obstacle.pose.position.x, obstacle.pose.position.y};
    const Point velocity{obstacle.velocity.x, obstacle.velocity.y};
    out.push_back({{obstacle.id, at, obstacle.radius, velocity},
                   yaw_of(obstacle.pose.orientation),
                   obstacle.length,
                   obstacle.width});
    if (!out.back().sound()) return std::nullopt;
  }
  return out;
}

std::optional<Point> from_msg(const geometry_msgs::PoseStamped& goal) {
  const auto& q = goal.pose.orientation;
  if (!within_each(goal.pose.position, kFarthest) || !std::isfinite(q.x + q.y + q.z + q.w))
    return std::nullopt;
  return Point{goal.pose.position.x, goal.pose.position.y};
}

plan::MapMessage from_msg(const octomap_msgs::Octomap& map) {
  plan::MapMessage out;
  out.data.assign(map.data.begin(), map.data.end());
  out.binary = map.binary != 0;
  out.id = map.id;
  out.resolution = map.resolution;
  return out;
}

std::string error_of(const octomap_msgs::Octomap& map, const std::string& frame) {
  if (map.header.frame_id != frame)
    return "it is in frame '" + map.header.frame_id + "', not '" + frame + "'";
  if (map.data.size() > map::kMaxMapBytes) return "it is larger than 64 MiB";
  return "";
}

std::optional<map::OccupancyGrid> from_msg(const nav_msgs::OccupancyGrid& map,
                                           const std::string& frame) {
  const auto& q = map.info.origin.orientation;
  const bool flat = std::abs(q.x) < 1e-3 && std::abs(q.y) < 1e-3;
  if (map.header.frame_id != frame || !within_each(map.info.origin.position, kFarthest) ||
      !rotation(q) || !flat || map.info.width > kMaxGridSide || map.info.height > kMaxGridSide)
    return std::nullopt;
  map::OccupancyGrid out;
  out.width = static_cast<int>(map.info.width);
  out.height = static_cast<int>(map.info.height);
  out.resolution = static_cast<double>(map.info.resolution);
  out.origin = {map.info.origin.position.x, map.info.origin.position.y};
  out.yaw = 2.0 * std::atan2(q.z, q.w);
  out.cells.assign(map.data.begin(), map.data.end());
  return out;
}

nav_msgs::Path to_msg(const Path& path, double z, const std::string& frame,
                      const ros::Time& stamp) {
  nav_msgs::Path out;
  out.header.frame_id = frame;
  out.header.stamp = stamp;
  for (std::size_t i = 0; i < path.size(); ++i) {
    geometry_msgs::PoseStamped pose;
    pose.header = out.header;
    pose.pose.position = point_msg(path[i], z);
    const std::size_t from = i + 1 < path.size() ? i : i - 1;
    const Point leg = path.size() > 1 ? path[from + 1] - path[from] : Point{1.0, 0.0};
    const double yaw = std::atan2(leg.y, leg.x);
    pose.pose.orientation.z = std::sin(yaw / 2);
    pose.pose.orientation.w = std::cos(yaw / 2);
    out.poses.push_back(pose);
  }
  return out;
}

navvi_msgs::Guidance to_msg(const guide::Status& status, double z, const std::string& frame,
                            const ros::Time& stamp) {
  navvi_msgs::Guidance out;
  out.header.frame_id = frame;
  out.header.stamp = stamp;
  out.state = static_cast<std::uint8_t>(status.state);
  out.refusal = static_cast<std::uint8_t>(status.refusal);
  out.replan_reason = static_cast<std::uint8_t>(status.reason);
  out.plans = status.plans;
  out.plan_time = status.plan_time;
  out.nodes_expanded = static_cast<std::uint32_t>(status.nodes_expanded);
  out.reroutes = status.reroutes;
  out.reroute_reason = static_cast<std::uint8_t>(status.reroute_reason);
  out.path_churn = status.churn;
  out.mesh_age = status.mesh_age.value_or(-1.0);
  out.map_age = status.map_age.value_or(-1.0);
  if (status.blocked) {
    out.blocked_distance = status.blocked->at;
    out.blocked_for = status.blocked->time_to_clear;
  }
  out.goal = point_msg(status.goal, z);
  out.waypoint = point_msg(status.heading.waypoint, z);
  out.waypoint_is_goal = status.heading.waypoint_is_goal;
  out.waypoint_distance = status.heading.waypoint_distance;
  out.waypoint_angle = status.heading.waypoint_angle;
  out.steer_angle = status.heading.steer_angle;
  out.turn_angle = status.heading.turn_angle;
  out.goal_distance = status.heading.goal_distance;
  out.eta = status.eta;
  out.shortest_length = status.shortest_length;
  out.smoothing_price = status.smoothing_price;
  out.path_offset = status.heading.path_offset;
  out.detail = status.detail;
  return out;
}

visualization_msgs::MarkerArray to_msg(const mesh::Mesh& mesh, double z, const std::string& frame,
                                       const ros::Time& stamp) {
  visualization_msgs::MarkerArray out;
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.header.stamp = stamp;
  marker.ns = "navmesh";
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.action =
      mesh.polygons.empty() ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.g = 1.0F;
  marker.color.b = 1.0F;
  marker.color.a = kMeshAlpha;
  for (const mesh::Polygon& polygon : mesh.polygons) {
    for (std::size_t k = 2; k < polygon.corners.size(); ++k) {
      for (const std::size_t corner : {std::size_t{0}, k - 1, k})
        marker.points.push_back(point_msg(mesh.at(polygon.corners[corner]), z + kAboveFloor));
    }
  }
  out.markers.push_back(std::move(marker));
  return out;
}

}  // namespace navvi_nav::node
