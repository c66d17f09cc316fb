#include "node/msg_conversion.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <navvi_types/limits.hpp>
#include <navvi_types/msg_conversion.hpp>

namespace navvi_perception::node {

using navvi_types::point_msg;
using navvi_types::Refusal;

namespace {

constexpr std::size_t kMostRays = 100'000;
constexpr std::size_t kMostPoints = 4'000'000;
constexpr double kMostCells = 100e6;
constexpr double kLongestScan = 1.0;  // s

bool within(double value, double low, double high) { return value >= low && value <= high; }

/// Some drivers have a range_min of 0, and mean no measurement by 0.
bool measured(const sensor_msgs::LaserScan& scan, float range) {
  return range > 0.0F && range >= scan.range_min && range < scan.range_max;
}

const sensor_msgs::PointField* field_of(const sensor_msgs::PointCloud2& cloud, const char* name) {
  using sensor_msgs::PointField;
  const auto found = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                  [&](const auto& field) { return field.name == name; });
  if (found == cloud.fields.end()) return nullptr;
  const std::size_t size = found->datatype == PointField::FLOAT32   ? sizeof(float)
                           : found->datatype == PointField::FLOAT64 ? sizeof(double)
                                                                    : 0;
  return size > 0 && std::uint64_t{found->offset} + size <= cloud.point_step ? &*found : nullptr;
}

/// Bytes from row to row: drivers leave row_step at 0, or at what it was before they filtered.
/// nullopt if the data holds neither packed rows nor rows of row_step.
std::optional<std::uint64_t> row_of(const sensor_msgs::PointCloud2& cloud) {
  const std::uint64_t packed = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.data.size() == packed * cloud.height) return packed;
  const std::uint64_t padded = std::uint64_t{cloud.row_step} * cloud.height;
  if (cloud.row_step >= packed && cloud.data.size() == padded) return cloud.row_step;
  return std::nullopt;
}

template <typename Number>
double number_at(const std::uint8_t* bytes, bool big) {
  std::array<std::uint8_t, sizeof(Number)> own{};
  std::copy_n(bytes, own.size(), own.begin());
  if (big) std::reverse(own.begin(), own.end());
  Number number{};
  std::memcpy(&number, own.data(), own.size());
  return static_cast<double>(number);
}

}  // namespace

Checked<sensor_msgs::LaserScan::ConstPtr> from_msg(const sensor_msgs::LaserScan& msg) {
  const double rays = static_cast<double>(msg.ranges.size());
  const double sweep = sweep_of(msg);
  if (msg.header.frame_id.empty()) return Refusal{"its frame_id is empty"};
  if (msg.ranges.empty()) return Refusal{"it has no rays"};
  if (msg.ranges.size() > kMostRays) return Refusal{"it has more than 100000 rays"};
  if (!(std::abs(msg.angle_min) <= 7.0F && std::abs(msg.angle_increment) <= 1.0F &&
        std::abs(rays * static_cast<double>(msg.angle_increment)) <= 7.0))
    return Refusal{
        "its angles are not those of one turn in rad: |angle_min| and the whole scan at most 7, "
        "angle_increment at most 1"};
  if (!within(msg.range_min, 0.0, msg.range_max) || !within(msg.range_max, 0.1, 1000.0))
    return Refusal{
        "its range_min and range_max are not in order: 0 to range_max, and 0.1 to 1000 m"};
  if (!within(sweep, 0.0, kLongestScan))
    return Refusal{"its time_increment makes a sweep of " + std::to_string(sweep) +
                   " s: 0 to 1 s are allowed, and 0 if it is not known"};
  return boost::make_shared<const sensor_msgs::LaserScan>(msg);
}

Checked<sensor_msgs::PointCloud2::ConstPtr> from_msg(const sensor_msgs::PointCloud2& msg) {
  if (msg.header.frame_id.empty()) return Refusal{"its frame_id is empty"};
  if (std::uint64_t{msg.width} * msg.height > kMostPoints)
    return Refusal{"it has more than 4000000 points"};
  const bool empty = msg.width == 0 || msg.height == 0;
  if (!empty && !row_of(msg))
    return Refusal{"its data has " + std::to_string(msg.data.size()) +
                   " bytes: height x width x point_step are needed, or height x row_step"};
  for (const char* name : {"x", "y", "z"})
    if (!empty && !field_of(msg, name))
      return Refusal{std::string("its field ") + name +
                     " is missing, outside point_step, or neither FLOAT32 nor FLOAT64"};
  return boost::make_shared<const sensor_msgs::PointCloud2>(msg);
}

Checked<sight::Prior> from_msg(const nav_msgs::OccupancyGrid& msg) {
  const Checked<navvi_types::Pose2> origin = navvi_types::origin_of(msg);
  if (!origin) return Refusal{origin.why()};
  const double cells = static_cast<double>(msg.info.width) * msg.info.height;
  if (!within(static_cast<double>(msg.info.resolution), 0.01, 1.0))
    return Refusal{"its resolution is not within 0.01 and 1 m"};
  if (!within(cells, 1.0, kMostCells)) return Refusal{"it has no cells, or more than 100 million"};
  if (static_cast<double>(msg.data.size()) != cells)
    return Refusal{"its data has " + std::to_string(msg.data.size()) +
                   " cells: width x height are needed"};
  if (!std::all_of(msg.data.begin(), msg.data.end(),
                   [](std::int8_t cell) { return cell >= -1 && cell <= 100; }))
    return Refusal{"a cell in it is not within -1 and 100"};
  sight::Prior prior{static_cast<double>(msg.info.resolution),
                     origin->position,
                     static_cast<int>(msg.info.width),
                     static_cast<int>(msg.info.height),
                     {msg.data.begin(), msg.data.end()}};
  prior.yaw = origin->yaw;
  return prior;
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
  if (count == 0) return points;
  const std::size_t row = *row_of(cloud);
  const std::array<const sensor_msgs::PointField*, 3> fields = {
      field_of(cloud, "x"), field_of(cloud, "y"), field_of(cloud, "z")};
  const bool big = cloud.is_bigendian != 0;
  for (std::size_t i = 0; i < count; i += each) {
    const std::uint8_t* const at =
        cloud.data.data() + i / cloud.width * row + i % cloud.width * cloud.point_step;
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis) {
      const sensor_msgs::PointField& field = *fields[static_cast<std::size_t>(axis)];
      point[axis] = field.datatype == sensor_msgs::PointField::FLOAT32
                        ? number_at<float>(at + field.offset, big)
                        : number_at<double>(at + field.offset, big);
    }
    if (point.allFinite() && point.cwiseAbs().maxCoeff() < navvi_types::kFarthest)
      points.push_back(point);
  }
  return points;
}

double sweep_of(const sensor_msgs::LaserScan& scan) {
  return (static_cast<double>(scan.ranges.size()) - 1.0) * static_cast<double>(scan.time_increment);
}

sensor_msgs::LaserScan plain(sensor_msgs::LaserScan scan, bool free) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (float& range : scan.ranges) {
    const bool nothing =
        free ? range == 0.0F || std::isnan(range) || range >= scan.range_max : range == kInf;
    if (nothing)
      range = kInf;
    else if (!measured(scan, range))
      range = kNan;
  }
  return scan;
}

sensor_msgs::LaserScan with_clear_rays(sensor_msgs::LaserScan scan) {
  for (float& range : scan.ranges)
    if (std::isinf(range)) range = std::nextafter(scan.range_max, 0.0F);
  return scan;
}

void add_points(const sensor_msgs::LaserScan& scan, const sensor_msgs::PointCloud2& cloud,
                sight::Sight& sight) {
  if (cloud.data.empty()) return;  // of which the iterators point nowhere
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

std::vector<visualization_msgs::Marker> robot_markers(double radius, double height,
                                                      const std::string& frame) {
  using visualization_msgs::Marker;
  Marker body;
  body.header.frame_id = frame;
  body.frame_locked = 1U;
  body.ns = "robot";
  body.type = Marker::CYLINDER;
  body.scale.x = body.scale.y = 2.0 * radius;
  body.scale.z = height;
  body.pose.position.z = 0.5 * height;
  body.pose.orientation.w = 1.0;
  body.color.r = body.color.g = body.color.b = body.color.a = 1.0F;
  Marker nose = body;
  nose.id = 1;
  nose.type = Marker::TRIANGLE_LIST;
  nose.scale.x = nose.scale.y = nose.scale.z = 1.0;
  nose.pose.position.z = height + 0.02;
  nose.color.r = nose.color.b = 0.0F;
  for (const auto& [x, y] : {std::pair{1.5, 0.0}, {-0.6, 0.75}, {-0.6, -0.75}})
    nose.points.push_back(point_msg({radius * x, radius * y}, 0.0));
  return {body, nose};
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
  // Of the last message nothing is left.
  add("", Marker::CYLINDER, Eigen::Vector3d::Zero()).action = Marker::DELETEALL;
  Marker& cubes = add("stands", Marker::CUBE_LIST, Eigen::Vector3d::Constant(resolution));
  for (const Eigen::Vector3d& middle : standing) cubes.points.push_back(point_msg(middle));
  if (standing.empty()) array.markers.pop_back();
  for (const navvi_types::MovingThing& thing : obstacles.things) {
    const Eigen::Vector3d foot(thing.pose.position.x(), thing.pose.position.y(), thing.floor);
    const Eigen::Vector3d middle = foot + Eigen::Vector3d(0.0, 0.0, 0.5 * thing.height);
    add("obstacles", Marker::CYLINDER, {2.0 * thing.radius, 2.0 * thing.radius, thing.height})
        .pose.position = point_msg(middle);
    if (thing.velocity.norm() == 0.0) continue;
    const Eigen::Vector3d way(thing.velocity.x(), thing.velocity.y(), 0.0);
    // Before and above the cylinder, which is flat where only a lidar saw the thing.
    const Eigen::Vector3d front =
        foot + thing.radius * way.normalized() + Eigen::Vector3d(0.0, 0.0, thing.height + 0.1);
    add("velocities", Marker::ARROW, {0.1, 0.25, 0.0}).points = {point_msg(front),
                                                                 point_msg(front + way)};
  }
  return array;
}

}  // namespace navvi_perception::node
