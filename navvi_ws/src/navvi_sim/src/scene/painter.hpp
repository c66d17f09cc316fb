#pragma once

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <navvi_types/msg_conversion.hpp>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::scene {

using navvi_types::point_msg;

struct Color {
  float r, g, b;
};

/// High contrast on a dark background. Purple and red are left to the path and the goal.
[[nodiscard]] Color color_of(ThingClass thing_class);

[[nodiscard]] std_msgs::ColorRGBA color_msg(const Color& color, float brightness = 1.0F);
[[nodiscard]] geometry_msgs::Pose pose_msg(const Eigen::Isometry3d& pose);
/// In the frame map, without a stamp. \param scale  m, in a list of triangles a factor
[[nodiscard]] visualization_msgs::Marker marker_msg(
    const std::string& ns, int id, int type, const Color& color,
    const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

/// Adds shapes to a TRIANGLE_LIST, a colour a triangle. RViz draws such a list unlit, so that a
/// colour is what it says from every side; a little shading by direction makes faces distinct.
class Painter {
 public:
  /// \param cut  m, z above which nothing is drawn; the tops of what is thin, such as walls, are
  ///             put back on the cut, so that they are seen from above
  Painter(visualization_msgs::Marker& msg, const Color& color, double cut)
      : msg_(msg), color_(color), cut_(cut) {}

  /// Counter-clockwise seen from outside.
  void triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  void shape(const Geometry& geometry, const Eigen::Isometry3d& pose);

 private:
  void box(const Box& box, const Eigen::Isometry3d& pose);
  void mesh(const Mesh& mesh, const Eigen::Isometry3d& pose);
  void cylinder(const Cylinder& cylinder, const Eigen::Isometry3d& pose);
  void sphere(const Sphere& sphere, const Eigen::Isometry3d& pose);
  void ring(const std::vector<Eigen::Vector3d>& lower, const std::vector<Eigen::Vector3d>& upper);
  [[nodiscard]] std::vector<Eigen::Vector3d> below_cut(
      const std::vector<Eigen::Vector3d>& corners) const;

  visualization_msgs::Marker& msg_;
  Color color_;
  double cut_;
};

}  // namespace navvi_sim::scene
