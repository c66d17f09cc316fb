#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <map>
#include <utility>

namespace navvi_rviz::look {

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
