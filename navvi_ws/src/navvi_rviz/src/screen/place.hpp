#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace navvi_rviz::screen {

using Rect = Eigen::AlignedBox2d;  ///< px, from the left upper corner of the picture

/// Something to be read beside a place of the picture.
struct Plate {
  Eigen::Vector2d anchor;  ///< px, of the place; may be outside
  Eigen::Vector2d size;    ///< px
  /// px, from the anchor to its left upper corner in the picture before
  std::optional<Eigen::Vector2d> before;
};

/// What plates leave free.
struct Taken {
  std::vector<Rect> always;  ///< a plate without room beside it is not drawn
  std::vector<Rect> rather;  ///< as long as there is room elsewhere
};

/// Where a plate is drawn: over its place if there is room, inside the picture, and never over what
/// is taken. One that had to go aside stays where it is until there is room over its place or much
/// nearer to it.
/// \return its left upper corner, px; nullopt: there is no room
[[nodiscard]] std::optional<Eigen::Vector2d> place(const Plate& plate,
                                                   const Eigen::Vector2d& picture,
                                                   const Taken& taken);

/// Where on the edge of the picture an arrow to something outside is drawn.
struct EdgeArrow {
  Eigen::Vector2d at;  ///< px, its middle
  double angle;        ///< rad, where it points; 0 is right, counter-clockwise
};

/// \param seen    in the camera's frame, m: x right, y up, z backwards
/// \param inside  px, where the place is on the screen, if it is before the camera
/// \param margin  px, from the edge
/// \return nullopt: the place is in the picture
[[nodiscard]] std::optional<EdgeArrow> edge_arrow(const Eigen::Vector3d& seen,
                                                  const std::optional<Eigen::Vector2d>& inside,
                                                  const Eigen::Vector2d& picture, double margin);

/// \param path   m, in map
/// \param ahead  m along it, from its place that is nearest to the robot
/// \return the path's end, if it is nearer; nullopt: there is no path
[[nodiscard]] std::optional<Eigen::Vector3d> way_ahead(const std::vector<Eigen::Vector3d>& path,
                                                       const Eigen::Vector2d& robot, double ahead);

}  // namespace navvi_rviz::screen
