#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "look/vision.hpp"

namespace navvi_rviz::look {

/// The namespace of lists of rectangles, two triangles each, that are seen from outside only.
inline constexpr char kStanding[] = "standing";

/// The markers of NavVI's nodes as a person with little sight sees them best: unlit, in a vision's
/// colours, and what matters with a bright edge in a dark one, so that it stands out from whatever
/// is behind it. Markers keep their namespace and id; the path's two become ribbons, the goal's and
/// the robot's get edges. Lists of cubes become one list for each part of the hall, as each list
/// costs as much as many triangles. Texts are left out: they are drawn on the screen.
[[nodiscard]] visualization_msgs::MarkerArray dress(const visualization_msgs::MarkerArray& markers,
                                                    const Vision& vision);

}  // namespace navvi_rviz::look
