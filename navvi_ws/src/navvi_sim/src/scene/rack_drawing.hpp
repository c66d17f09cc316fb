#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "scene/painter.hpp"

namespace navvi_sim::scene {

/// m, the longest cube in a list: RViz leaves out a list of cubes of which it sees no centre, and
/// darkens cubes towards their ends.
constexpr double kLongestCube = 1.25;

struct ColoredCube {
  Eigen::AlignedBox3d cube;  ///< m, about the centre of the box that it is drawn for
  Color color;
};

/// How a box of a shelf is drawn, so that the shelf is seen into: a large cube as an open rack of
/// uprights and boards, the highest board as a rim. No cube is longer than kLongestCube.
/// \param size     m, of the box
/// \param highest  nothing of the shelf is above it
[[nodiscard]] std::vector<ColoredCube> shelf_parts(const Eigen::Vector3d& size, bool highest);

}  // namespace navvi_sim::scene
