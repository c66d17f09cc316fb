#include "navvi_sim/msg_conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace navvi_sim {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr const char* kFrame = "map";
constexpr double kWallCut = 1.0;  // m above the floor, to which walls are drawn
constexpr double kCut = 2.7;      // m above the floor, to which everything else is drawn

struct Color {
  float r, g, b;
};

/// High contrast on a dark background. Purple and red are left to the path and the goal.
Color color_of(ThingClass thing_class) {
  switch (thing_class) {
    case ThingClass::floor:
      return {0.07F, 0.08F, 0.09F};
    case ThingClass::shelf:
      return {0.33F, 0.45F, 0.58F};
    case ThingClass::wall:
      return {0.78F, 0.78F, 0.78F};
    case ThingClass::box:
      return {1.00F, 0.90F, 0.00F};
    case ThingClass::pedestal:
      return {0.72F, 0.42F, 0.16F};
    case ThingClass::worker:
      return {0.20F, 1.00F, 0.35F};
    case ThingClass::forklift:
      return {1.00F, 0.50F, 0.00F};
    case ThingClass::pallet_robot:
      return {0.00F, 0.80F, 0.80F};
    case ThingClass::other:
      return {0.55F, 0.55F, 0.50F};
  }
  return {0.55F, 0.55F, 0.50F};
}

constexpr Color kRobot{0.95F, 1.00F, 0.95F};
constexpr Color kNose{0.00F, 1.00F, 0.20F};

geometry_msgs::Point point(const Eigen::Vector3d& p) {
  geometry_msgs::Point msg;
  msg.x = p.x();
  msg.y = p.y();
  msg.z = p.z();
  return msg;
}

geometry_msgs::Pose pose_msg(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(pose.linear()).normalized();
  geometry_msgs::Pose msg;
  msg.position = point(pose.translation());
  msg.orientation.x = rotation.x();
  msg.orientation.y = rotation.y();
  msg.orientation.z = rotation.z();
  msg.orientation.w = rotation.w();
  return msg;
}

std_msgs::ColorRGBA color_msg(const Color& color, float brightness = 1.0F) {
  std_msgs::ColorRGBA msg;
  msg.r = color.r * brightness;
  msg.g = color.g * brightness;
  msg.b = color.b * brightness;
  msg.a = 1.0F;
  return msg;
}

Marker marker(const std::string& ns, int id, int type, const Color& color, const ros::Time& stamp) {
  Marker msg;
  msg.header.frame_id = kFrame;
  msg.header.stamp = stamp;
  msg.ns = ns;
  msg.id = id;
  msg.type = type;
  msg.action = Marker::ADD;
  msg.pose.orientation.w = 1.0;
  msg.scale.x = msg.scale.y = msg.scale.z = 1.0;
  msg.color = color_msg(color);
  return msg;
}

/// Makes of one shape one marker.
class ShapeMarker {
 public:
  explicit ShapeMarker(Marker& msg) : msg_(msg) {}

  void operator()(const Box& box) const { set(Marker::CUBE, box.size); }
  void operator()(const Cylinder& cylinder) const {
    set(Marker::CYLINDER, {2.0 * cylinder.radius, 2.0 * cylinder.radius, cylinder.length});
  }
  void operator()(const Sphere& sphere) const {
    set(Marker::SPHERE, Eigen::Vector3d::Constant(2.0 * sphere.radius));
  }
  void operator()(const std::shared_ptr<const Mesh>& mesh) const {
    set(Marker::TRIANGLE_LIST, Eigen::Vector3d::Ones());
    msg_.points.reserve(3 * mesh->triangles.size());
    for (const auto& triangle : mesh->triangles)
      for (const std::uint32_t index : triangle)
        msg_.points.push_back(point(mesh->vertices[index].cast<double>()));
  }

 private:
  void set(int type, const Eigen::Vector3d& scale) const {
    msg_.type = type;
    msg_.scale.x = scale.x();
    msg_.scale.y = scale.y();
    msg_.scale.z = scale.z();
  }

  Marker& msg_;
};

/// Adds triangles with their colours. RViz draws such a list unlit, so that a colour is what it
/// says from every side; a little shading by direction tells the faces apart.
class Painter {
 public:
  /// \param cut  m, z above which nothing is drawn
  Painter(Marker& msg, const Color& color, double cut) : msg_(msg), color_(color), cut_(cut) {}

  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    const double shade = 0.74 + 0.26 * std::max(0.0, normal.z()) + 0.12 * std::abs(normal.x());
    const float brightness = static_cast<float>(std::min(1.0, shade));
    const std::vector<Eigen::Vector3d> corners = below_cut({a, b, c});
    for (std::size_t i = 2; i < corners.size(); ++i)
      for (const Eigen::Vector3d& corner : {corners[0], corners[i - 1], corners[i]}) {
        msg_.points.push_back(point(corner));
        msg_.colors.push_back(color_msg(color_, brightness));
      }
  }

  /// The twelve triangles of a box, counter-clockwise seen from outside.
  void box(const Box& box, const Eigen::Isometry3d& pose) {
    constexpr std::array<std::array<double, 2>, 4> kRound{
        {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      for (const double side : {-0.5, 0.5}) {
        std::array<Eigen::Vector3d, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) {
          Eigen::Vector3d corner;
          corner[axis] = side * box.size[axis];
          corner[u] = kRound[i][side > 0.0 ? 0 : 1] * box.size[u];
          corner[v] = kRound[i][side > 0.0 ? 1 : 0] * box.size[v];
          corners[i] = pose * corner;
        }
        triangle(corners[0], corners[1], corners[2]);
        triangle(corners[0], corners[2], corners[3]);
      }
    }
  }

  void mesh(const Mesh& mesh, const Eigen::Isometry3d& pose) {
    for (const auto& indices : mesh.triangles)
      triangle(pose * mesh.vertices[indices[0]].cast<double>(),
               pose * mesh.vertices[indices[1]].cast<double>(),
               pose * mesh.vertices[indices[2]].cast<double>());
  }

 private:
  /// The part of a polygon below the cut (Sutherland and Hodgman, 1974).
  [[nodiscard]] std::vector<Eigen::Vector3d> below_cut(
      const std::vector<Eigen::Vector3d>& corners) const {
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d& here = corners[i];
      const Eigen::Vector3d& next = corners[(i + 1) % corners.size()];
      if (here.z() <= cut_) kept.push_back(here);
      if ((here.z() <= cut_) != (next.z() <= cut_))
        kept.push_back(here + (next - here) * ((cut_ - here.z()) / (next.z() - here.z())));
    }
    return kept;
  }

  Marker& msg_;
  Color color_;
  double cut_;
};

void append_shapes(MarkerArray& array, std::map<std::string, int>& next_id, const Thing& thing,
                   const Eigen::Isometry3d& pose, const ros::Time& stamp) {
  for (const Shape& shape : thing.shapes) {
    const ThingClass look = look_of(thing, shape);
    const std::string ns = to_string(look);
    Marker msg = marker(ns, next_id[ns]++, Marker::CUBE, color_of(look), stamp);
    std::visit(ShapeMarker(msg), shape.geometry);
    msg.pose = pose_msg(pose * shape.pose);
    array.markers.push_back(std::move(msg));
  }
}

void append_robot(MarkerArray& array, const RobotBody& robot, const ros::Time& stamp) {
  const auto above = [&](double z) { return pose_msg(robot.pose * Eigen::Translation3d(0, 0, z)); };
  Marker body = marker("robot", 0, Marker::CYLINDER, kRobot, stamp);
  body.pose = above(robot.height / 2.0);
  body.scale.x = body.scale.y = 2.0 * robot.radius;
  body.scale.z = robot.height;
  array.markers.push_back(body);

  // A flat arrow head over the lid, its tip over the rim, says where ahead is.
  Marker nose = marker("robot", 1, Marker::TRIANGLE_LIST, kNose, stamp);
  nose.pose = above(robot.height + 0.02);
  Painter(nose, kNose, std::numeric_limits<double>::max())
      .triangle({1.5 * robot.radius, 0.0, 0.0}, {-0.6 * robot.radius, 0.75 * robot.radius, 0.0},
                {-0.6 * robot.radius, -0.75 * robot.radius, 0.0});
  array.markers.push_back(nose);
}

}  // namespace

octomap_msgs::Octomap to_msg(const octomap::OcTree& map, const ros::Time& stamp) {
  octomap_msgs::Octomap msg;
  msg.header.frame_id = kFrame;
  msg.header.stamp = stamp;
  msg.binary = true;
  msg.id = map.getTreeType();
  msg.resolution = map.getResolution();
  std::ostringstream stream;
  map.writeBinaryData(stream);
  const std::string data = stream.str();
  msg.data.assign(data.begin(), data.end());
  return msg;
}

MarkerArray occupied_cells_msg(const octomap::OcTree& map, const ros::Time& stamp) {
  constexpr Color kVoxel{0.35F, 0.38F, 0.42F};
  MarkerArray array;
  for (unsigned depth = 0; depth <= map.getTreeDepth(); ++depth) {
    Marker msg = marker("map", static_cast<int>(depth), Marker::CUBE_LIST, kVoxel, stamp);
    msg.scale.x = msg.scale.y = msg.scale.z = map.getNodeSize(depth);
    msg.action = Marker::DELETE;
    array.markers.push_back(std::move(msg));
  }
  for (auto leaf = map.begin_leafs(); leaf != map.end_leafs(); ++leaf) {
    if (!map.isNodeOccupied(*leaf)) continue;
    Marker& msg = array.markers[leaf.getDepth()];
    msg.action = Marker::ADD;
    msg.points.push_back(point({leaf.getX(), leaf.getY(), leaf.getZ()}));
  }
  return array;
}

MarkerArray scene_msg(const WorldDescription& world, const ros::Time& stamp) {
  MarkerArray array;
  std::map<std::string, int> next_id;
  std::map<ThingClass, Marker> triangles;  // all flat faces of a class at once: one thing to draw
  const auto painter = [&](ThingClass thing_class) {
    const std::string ns = to_string(thing_class);
    const Color color = color_of(thing_class);
    if (triangles.count(thing_class) == 0)
      triangles[thing_class] = marker(ns, next_id[ns]++, Marker::TRIANGLE_LIST, color, stamp);
    const double cut = thing_class == ThingClass::wall ? kWallCut : kCut;
    return Painter(triangles[thing_class], color, world.floor_height + cut);
  };
  for (const Thing& thing : world.things) {
    if (thing.route) continue;
    Thing round = thing;
    round.shapes.clear();
    for (const Shape& shape : thing.shapes) {
      const Eigen::Isometry3d pose = thing.pose * shape.pose;
      if (const auto* box = std::get_if<Box>(&shape.geometry))
        painter(look_of(thing, shape)).box(*box, pose);
      else if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry))
        painter(look_of(thing, shape)).mesh(**mesh, pose);
      else if (pose.translation().z() < world.floor_height + kCut)
        round.shapes.push_back(shape);
    }
    append_shapes(array, next_id, round, thing.pose, stamp);
  }
  for (auto& [thing_class, msg] : triangles) array.markers.push_back(std::move(msg));
  return array;
}

MarkerArray moving_scene_msg(const WorldDescription& world, const std::vector<MovingPose>& movers,
                             const RobotBody& robot, const ros::Time& stamp) {
  MarkerArray array;
  std::map<std::string, int> next_id;
  for (const MovingPose& mover : movers)
    append_shapes(array, next_id, world.things.at(mover.thing), mover.pose, stamp);
  append_robot(array, robot, stamp);
  return array;
}

}  // namespace navvi_sim
