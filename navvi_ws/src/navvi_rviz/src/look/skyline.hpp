#pragma once

#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <map>
#include <utility>
#include <vector>

namespace navvi_rviz::look {

/// What a marker fills: a box around each cube or triangle of a list, or around the whole.
/// \return m, in the marker's frame_id; none for single lines and texts, and for what is taken away
[[nodiscard]] std::vector<Eigen::AlignedBox3d> solids(const visualization_msgs::Marker& marker);

/// How high the scene is at each place of the floor, so that a camera can look over it.
class Skyline {
 public:
  /// Takes a scene in place of the one before. The floor is left out.
  explicit Skyline(const visualization_msgs::MarkerArray& scene = {});

  /// The steepest look up that the scene asks for: of the line from `place` towards `back` that
  /// clears all within `reach`.
  /// \param place  m, in map
  /// \param back   of length 1
  /// \param reach  m
  /// \return metres up a metre, >= 0
  [[nodiscard]] double slope_over(const Eigen::Vector3d& place, const Eigen::Vector2d& back,
                                  double reach) const;

 private:
  void raise(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  std::map<std::pair<int, int>, double> heights_;  ///< m, by cell
};

}  // namespace navvi_rviz::look
