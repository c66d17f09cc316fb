#include "scene/painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace navvi_sim::scene {
namespace {

constexpr int kRound = 16;     // corners of a circle
constexpr int kRings = 6;      // of a sphere
constexpr double kThin = 0.6;  // m

/// The smallest height of a triangle.
double width(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return (b - a).cross(c - a).norm() / longest;
}

std::vector<Eigen::Vector3d> circle(const Eigen::Isometry3d& pose, double radius, double z) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < kRound; ++i) {
    const double angle = 2.0 * kPi * i / kRound;
    points.push_back(pose * Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z));
  }
  return points;
}

}  // namespace

Color color_of(ThingClass thing_class) {
  static constexpr std::array<Color, names(ThingClass{}).size()> kColors{{
      {0.07F, 0.08F, 0.09F},  // floor
      {0.33F, 0.45F, 0.58F},  // shelf
      {0.78F, 0.78F, 0.78F},  // wall
      {1.00F, 0.90F, 0.00F},  // box
      {0.72F, 0.42F, 0.16F},  // pedestal
      {0.20F, 1.00F, 0.35F},  // worker
      {1.00F, 0.50F, 0.00F},  // forklift
      {0.00F, 0.80F, 0.80F},  // pallet robot
      {0.55F, 0.55F, 0.50F},  // other
  }};
  return kColors[static_cast<std::size_t>(thing_class)];
}

std_msgs::ColorRGBA color_msg(const Color& color, float brightness) {
  std_msgs::ColorRGBA msg;
  msg.r = color.r * brightness;
  msg.g = color.g * brightness;
  msg.b = color.b * brightness;
  msg.a = 1.0F;
  return msg;
}

geometry_msgs::Pose pose_msg(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(pose.linear()).normalized();
  geometry_msgs::Pose msg;
  msg.position = point_msg(pose.translation());
  msg.orientation.x = rotation.x();
  msg.orientation.y = rotation.y();
  msg.orientation.z = rotation.z();
  msg.orientation.w = rotation.w();
  return msg;
}

visualization_msgs::Marker marker_msg(const std::string& ns, int id, int type, const Color& color,
                                      const Eigen::Vector3d& scale) {
  visualization_msgs::Marker msg;
  msg.header.frame_id = "map";
  msg.ns = ns;
  msg.id = id;
  msg.type = type;
  msg.action = visualization_msgs::Marker::ADD;
  msg.pose.orientation.w = 1.0;
  msg.scale.x = scale.x();
  msg.scale.y = scale.y();
  msg.scale.z = scale.z();
  msg.color = color_msg(color);
  return msg;
}

void Painter::triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const double shade = 0.74 + 0.26 * std::max(0.0, normal.z()) + 0.12 * std::abs(normal.x());
  const std_msgs::ColorRGBA color = color_msg(color_, static_cast<float>(std::min(1.0, shade)));
  std::vector<Eigen::Vector3d> corners = below_cut({a, b, c});
  if (corners.empty() && normal.z() > 0.9 && width(a, b, c) < kThin) {
    corners = {a, b, c};
    for (Eigen::Vector3d& corner : corners) corner.z() = cut_;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    for (const Eigen::Vector3d& corner : {corners[0], corners[i - 1], corners[i]})
      msg_.points.push_back(point_msg(corner));
    msg_.colors.push_back(color);
  }
}

void Painter::shape(const Geometry& geometry, const Eigen::Isometry3d& pose) {
  if (const auto* flat = std::get_if<Box>(&geometry)) return box(*flat, pose);
  if (const auto* tube = std::get_if<Cylinder>(&geometry)) return cylinder(*tube, pose);
  if (const auto* ball = std::get_if<Sphere>(&geometry)) return sphere(*ball, pose);
  mesh(*std::get<std::shared_ptr<const Mesh>>(geometry), pose);
}

void Painter::box(const Box& box, const Eigen::Isometry3d& pose) {
  constexpr std::array<std::array<double, 2>, 4> kCorners{
      {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const double side : {-0.5, 0.5}) {
      std::array<Eigen::Vector3d, 4> corners;
      for (std::size_t i = 0; i < 4; ++i) {
        Eigen::Vector3d corner;
        corner[axis] = side * box.size[axis];
        corner[u] = kCorners[i][side > 0.0 ? 0 : 1] * box.size[u];
        corner[v] = kCorners[i][side > 0.0 ? 1 : 0] * box.size[v];
        corners[i] = pose * corner;
      }
      triangle(corners[0], corners[1], corners[2]);
      triangle(corners[0], corners[2], corners[3]);
    }
  }
}

void Painter::mesh(const Mesh& mesh, const Eigen::Isometry3d& pose) {
  for (const auto& indices : mesh.triangles)
    triangle(pose * mesh.vertices[indices[0]].cast<double>(),
             pose * mesh.vertices[indices[1]].cast<double>(),
             pose * mesh.vertices[indices[2]].cast<double>());
}

void Painter::cylinder(const Cylinder& cylinder, const Eigen::Isometry3d& pose) {
  const auto lower = circle(pose, cylinder.radius, -0.5 * cylinder.length);
  const auto upper = circle(pose, cylinder.radius, 0.5 * cylinder.length);
  ring(lower, upper);
  for (std::size_t i = 2; i < upper.size(); ++i) {
    triangle(upper[0], upper[i - 1], upper[i]);
    triangle(lower[0], lower[i], lower[i - 1]);
  }
}

void Painter::sphere(const Sphere& sphere, const Eigen::Isometry3d& pose) {
  const auto at_latitude = [&](int i) {
    const double latitude = kPi * (static_cast<double>(i) / kRings - 0.5);
    return circle(pose, sphere.radius * std::cos(latitude), sphere.radius * std::sin(latitude));
  };
  for (int i = 0; i < kRings; ++i) ring(at_latitude(i), at_latitude(i + 1));
}

/// The band between two circles; one of them may be a point.
void Painter::ring(const std::vector<Eigen::Vector3d>& lower,
                   const std::vector<Eigen::Vector3d>& upper) {
  const auto thin = [](const std::vector<Eigen::Vector3d>& circle) {
    return (circle[0] - circle[kRound / 2]).norm() < 1e-9;
  };
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const std::size_t next = (i + 1) % lower.size();
    if (!thin(lower)) triangle(lower[i], lower[next], upper[next]);
    if (!thin(upper)) triangle(lower[i], upper[next], upper[i]);
  }
}

/// The part of a polygon below the cut (Sutherland and Hodgman, 1974).
std::vector<Eigen::Vector3d> Painter::below_cut(const std::vector<Eigen::Vector3d>& corners) const {
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

}  // namespace navvi_sim::scene
