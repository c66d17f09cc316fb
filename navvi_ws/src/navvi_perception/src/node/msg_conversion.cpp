#include "node/msg_conversion.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <navvi_types/limits.hpp>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_perception::node {
namespace {

constexpr std::size_t kMostRays = 100'000;
constexpr std::size_t kMostPoints = 4'000'000;
constexpr double kMostCells = 100e6;
constexpr float kLongestScan = 1.0F;  // s
constexpr double kLevel = 1e-3;       // of a quaternion's x, y and z

bool within(double value, double low, double high) { return value >= low && value <= high; }

bool measured(const sensor_msgs::LaserScan& scan, float range) {
  return range >= scan.range_min && range <= scan.range_max;
}

const sensor_msgs::PointField* field_of(const sensor_msgs::PointCloud2& cloud, const char* name) {
  const auto found = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const auto& field) { return field.name == name; });
  const bool good = found != cloud.fields.end() &&
                    found->datatype == sensor_msgs::PointField::FLOAT32 &&
                    std::uint64_t{found->offset} + sizeof(float) <= cloud.point_step;
  return good ? &*found : nullptr;
}

}  // namespace

std::optional<sensor_msgs::LaserScan::ConstPtr> from_msg(const sensor_msgs::LaserScan& msg) {
  const double rays = static_cast<double>(msg.ranges.size());
  const bool sound =
      !msg.header.frame_id.empty() && !msg.ranges.empty() && msg.ranges.size() <= kMostRays &&
      std::abs(msg.angle_min) <= 7.0F && std::abs(msg.angle_increment) <= 1.0F &&
      std::abs(rays * static_cast<double>(msg.angle_increment)) <= 7.0 &&
      within(msg.range_min, 0.0, msg.range_max) && within(msg.range_max, 0.1, 1000.0) &&
      within(rays * static_cast<double>(msg.time_increment), 0.0, kLongestScan) &&
      std::any_of(msg.ranges.begin(), msg.ranges.end(), [&](float range) {
        return measured(msg, range) || (std::isinf(range) && range > 0.0F);
      });
  if (!sound) return std::nullopt;
  return boost::make_shared<const sensor_msgs::LaserScan>(msg);
}

std::optional<sensor_msgs::PointCloud2::ConstPtr> from_msg(const sensor_msgs::PointCloud2& msg) {
  const std::uint64_t points = std::uint64_t{msg.width} * msg.height;
  const bool sound = !msg.header.frame_id.empty() && points > 0 && points <= kMostPoints &&
                     !msg.is_bigendian &&
                     msg.row_step == std::uint64_t{msg.width} * msg.point_step &&
                     msg.data.size() == std::uint64_t{msg.row_step} * msg.height &&
                     field_of(msg, "x") && field_of(msg, "y") && field_of(msg, "z");
  if (!sound || points_of(msg, kMostPoints).empty()) return std::nullopt;
  return boost::make_shared<const sensor_msgs::PointCloud2>(msg);
}

std::optional<sight::Prior> from_msg(const nav_msgs::OccupancyGrid& msg) {
  const auto& q = msg.info.origin.orientation;
  const auto& at = msg.info.origin.position;
  const double cells = static_cast<double>(msg.info.width) * msg.info.height;
  const bool sound =
      within(at.x, -navvi_types::kFarthest, navvi_types::kFarthest) &&
      within(at.y, -navvi_types::kFarthest, navvi_types::kFarthest) &&
      within(static_cast<double>(msg.info.resolution), 0.01, 1.0) &&
      within(q.w * q.w, 1.0 - navvi_types::kUnitSlack, 1.0 + navvi_types::kUnitSlack) &&
      within(q.x, -kLevel, kLevel) && within(q.y, -kLevel, kLevel) &&
      within(q.z, -kLevel, kLevel) && within(cells, 1.0, kMostCells) &&
      static_cast<double>(msg.data.size()) == cells &&
      std::all_of(msg.data.begin(), msg.data.end(),
                  [](std::int8_t cell) { return cell >= -1 && cell <= 100; });
  if (!sound) return std::nullopt;
  return sight::Prior{static_cast<double>(msg.info.resolution),
                      {at.x, at.y},
                      static_cast<int>(msg.info.width),
                      static_cast<int>(msg.info.height),
                      {msg.data.begin(), msg.data.end()}};
}

std::optional<Eigen::Isometry3d> pose_of(const geometry_msgs::Transform& transform) {
  if (!navvi_types::from_msg(transform)) return std::nullopt;
  const auto& q = transform.rotation;
  const auto& at = transform.translation;
  return Eigen::Translation3d(at.x, at.y, at.z) *
         Eigen::Isometry3d(Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized());
}

std::vector<Eigen::Vector3d> points_of(const sensor_msgs::PointCloud2& cloud, std::size_t most) {
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  const std::size_t each = (count + most - 1) / std::max<std::size_t>(1, most);
  std::vector<Eigen::Vector3d> points;
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  for (std::size_t i = 0; i < count; ++i, ++x, ++y, ++z) {
    const Eigen::Vector3d point(static_cast<double>(*x), static_cast<double>(*y),
                                static_cast<double>(*z));
    if (i % each == 0 && point.allFinite() && point.cwiseAbs().maxCoeff() < navvi_types::kFarthest)
      points.push_back(point);
  }
  return points;
}

sensor_msgs::LaserScan with_clear_rays(sensor_msgs::LaserScan scan) {
  for (float& range : scan.ranges)
    if (range > 0.0F && std::isinf(range)) range = std::nextafter(scan.range_max, 0.0F);
  return scan;
}

void add_points(const sensor_msgs::LaserScan& scan, const sensor_msgs::PointCloud2& cloud,
                sight::Sight& sight) {
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  sensor_msgs::PointCloud2ConstIterator<std::int32_t> index(cloud, "index");
  for (std::size_t i = 0; i < std::size_t{cloud.width} * cloud.height;
       ++i, ++x, ++y, ++z, ++index) {
    const auto ray = static_cast<std::size_t>(*index);
    const Eigen::Vector3d point(static_cast<double>(*x), static_cast<double>(*y),
                                static_cast<double>(*z));
    if (!point.allFinite() || ray >= scan.ranges.size()) continue;
    (std::isinf(scan.ranges[ray]) ? sight.clear : sight.hits).push_back(point);
  }
}

octomap_msgs::Octomap map_msg(const std::vector<std::int8_t>& bytes, double resolution,
                              std::int64_t stamp, const std::string& frame) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = frame;
  msg.header.stamp = navvi_types::from_ns(stamp);
  msg.binary = true;
  msg.id = "OcTree";
  msg.resolution = resolution;
  msg.data = bytes;
  return msg;
}

visualization_msgs::MarkerArray seen_msg(const std::vector<Eigen::Vector3d>& standing,
                                         double resolution, const navvi_types::Obstacles& obstacles,
                                         const std::string& frame) {
  using visualization_msgs::Marker;
  visualization_msgs::MarkerArray array;
  const auto add = [&](const char* name, int type, const Eigen::Vector3d& scale) -> Marker& {
    Marker& marker = array.markers.emplace_back();
    marker.header.frame_id = frame;
    marker.header.stamp = navvi_types::from_ns(obstacles.stamp);
    marker.ns = name;
    marker.id = static_cast<int>(array.markers.size());
    marker.type = type;
    marker.scale.x = scale.x();
    marker.scale.y = scale.y();
    marker.scale.z = scale.z();
    marker.pose.orientation.w = 1.0;
    marker.color.r = type == Marker::CUBE_LIST ? 0.0F : 1.0F;
    marker.color.g = type == Marker::CUBE_LIST ? 0.9F : 0.5F;
    marker.color.b = type == Marker::CUBE_LIST ? 1.0F : 0.0F;
    marker.color.a = type == Marker::CYLINDER ? 0.6F : 1.0F;
    return marker;
  };
  const auto point = [](const Eigen::Vector3d& at) {
    geometry_msgs::Point out;
    out.x = at.x();
    out.y = at.y();
    out.z = at.z();
    return out;
  };
  // Of the last message nothing is left.
  add("", Marker::CYLINDER, Eigen::Vector3d::Zero()).action = Marker::DELETEALL;
  Marker& cubes = add("stands", Marker::CUBE_LIST, Eigen::Vector3d::Constant(resolution));
  for (const Eigen::Vector3d& middle : standing) cubes.points.push_back(point(middle));
  if (standing.empty()) array.markers.pop_back();
  for (const navvi_types::MovingThing& thing : obstacles.things) {
    const Eigen::Vector3d foot(thing.pose.position.x(), thing.pose.position.y(), thing.floor);
    const Eigen::Vector3d middle = foot + Eigen::Vector3d(0.0, 0.0, 0.5 * thing.height);
    add("obstacles", Marker::CYLINDER, {2.0 * thing.radius, 2.0 * thing.radius, thing.height})
        .pose.position = point(middle);
    if (thing.velocity.norm() == 0.0) continue;
    const Eigen::Vector3d way(thing.velocity.x(), thing.velocity.y(), 0.0);
    // Before and above the cylinder, which is flat where only a lidar saw the thing.
    const Eigen::Vector3d front =
        foot + thing.radius * way.normalized() + Eigen::Vector3d(0.0, 0.0, thing.height + 0.1);
    add("velocities", Marker::ARROW, {0.1, 0.25, 0.0}).points = {point(front), point(front + way)};
  }
  return array;
}

}  // namespace navvi_perception::node
