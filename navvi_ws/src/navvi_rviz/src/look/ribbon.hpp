#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace navvi_rviz::look {

struct Color {
  float r, g, b;
};

[[nodiscard]] std_msgs::ColorRGBA color_msg(const Color& color);

// Shapes for a TRIANGLE_LIST, with a colour a triangle: RViz draws such a list unlit.
void add_triangle(const std::array<geometry_msgs::Point, 3>& corners, const Color& color,
                  visualization_msgs::Marker& marker);
void add_quad(const std::array<geometry_msgs::Point, 4>& corners, const Color& color,
              visualization_msgs::Marker& marker);

/// The line with its corners as arcs, as wide as the legs beside them let them be: what lies beside
/// it neither pinches nor splits there. m
[[nodiscard]] std::vector<Eigen::Vector2d> rounded(const std::vector<Eigen::Vector2d>& line);

/// A flat band along a line, between two distances from it, m, to the left (a right one is < 0).
/// \param line    m; where its ends are in one place, the band is closed
/// \param height  m
void add_ribbon(const std::vector<Eigen::Vector2d>& line, double from, double to, double height,
                const Color& color, visualization_msgs::Marker& marker);
/// Two of them, one on each side.
void add_borders(const std::vector<Eigen::Vector2d>& line, double from, double to, double height,
                 const Color& color, visualization_msgs::Marker& marker);

}  // namespace navvi_rviz::look
