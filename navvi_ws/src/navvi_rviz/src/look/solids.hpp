#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <vector>

namespace navvi_rviz::look {

/// What a marker fills: a box around each cube or triangle of a list, or around the whole.
/// \return m, in the marker's frame_id; none for single lines and texts, and for what is taken away
[[nodiscard]] std::vector<Eigen::AlignedBox3d> solids(const visualization_msgs::Marker& marker);

}  // namespace navvi_rviz::look
